"""A request to stop, which signals raise and which all processes of a study receive."""
import os
import signal

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1)


class Stop:
    """A request to stop. It is a pipe whose reading end becomes readable, in every process that has it, when the
    request is raised or when this process ends."""

    def __init__(self):
        self.reader, self.writer = os.pipe()
        self.is_raised = False

    def raise_on_signals(self):
        for number in SIGNALS:
            if signal.getsignal(number) != signal.SIG_IGN:
                signal.signal(number, self.on_signal)

    def on_signal(self, number, _frame):
        if not self.is_raised:
            self.is_raised = True
            os.close(self.writer)
