"""A request to stop the cases of a study. Signals raise it, and all processes of the study see it."""
import os
import signal

# Signals after which the running cases write checkpoints before the study ends. Any other signal keeps its default
# action, so that the study ends at once and its runs stop with checkpoints on their own (case.run_program). Job scripts
# can ask Slurm for SIGUSR1 some time before their time limit.
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1)


class Stop:
    """A request to stop, in the form of a pipe. Raising the request closes the writing end `writer`. This makes the
    reading end `reader` readable in all processes that inherited it, so that each can wait for it with select(). The
    same happens if the process ends that made the pipe. Processes that it forks must therefore close their copies of
    `writer`. `is_raised` tells only the process that made the pipe whether the request was raised."""

    def __init__(self):
        self.reader, self.writer = os.pipe()
        self.is_raised = False

    def raise_on_signals(self):
        """Lets SIGNALS raise the request. Signals that this process ignores stay ignored, as SIGHUP under nohup."""
        for number in SIGNALS:
            if signal.getsignal(number) != signal.SIG_IGN:
                signal.signal(number, self.on_signal)

    def on_signal(self, number, _frame):
        """Raises the request at the first signal. Further signals change nothing, so they cannot hurry the end."""
        if not self.is_raised:
            self.is_raised = True
            os.close(self.writer)
