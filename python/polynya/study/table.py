"""Progress of `polynya study run` on stderr: a live table on a terminal, otherwise a line now and then."""
import dataclasses
import sys
import time

# Largest number of running cases whose numbers the table lists; further ones become "…". With many more, the line would
# be wider than a terminal, and the table would no longer be drawn over itself.
MOST_NAMED = 12
# Least time between two updates of the table, and between two lines if there is no terminal [s]. Larger: the numbers
# are older. Smaller: a log of a study has more lines.
LIVE_PAUSE, LINE_PAUSE = 0.2, 10.0
CLEAR_LINE = "\033[K"  # deletes the rest of a line of a terminal, if the new text is shorter than the old


@dataclasses.dataclass
class Counts:
    """Numbers of cases of a study. A case has ended if it is done or failed."""

    total: int  # number of the cases that the command was asked for, also those that ended before
    done: int = 0  # number of finished cases, also before this command
    failed: int = 0  # number of failed cases, also before this command, unless they run again
    # Cases that ended before their time and continue from a checkpoint when the command runs again. They are not ended.
    stopped: int = 0
    running: list = dataclasses.field(default_factory=list)  # numbers of the cases that run
    before: int = 0  # number of cases that had ended before this command; they do not count for the rate
    # Time of time.monotonic() at which this command began [s].
    began: float = dataclasses.field(default_factory=time.monotonic)

    def left(self):
        """Remaining time, as clock() writes it, at the average rate of this command so far; a dash before its first
        case has ended."""
        ended = self.done + self.failed - self.before
        if ended <= 0:
            return "–"
        return clock((self.total - self.done - self.failed) * (time.monotonic() - self.began) / ended)

    def line(self):
        """The counts in one line, for a log. Stopped cases are named only if there are any."""
        stopped = f"{self.stopped} stopped, " if self.stopped else ""
        return (
            f"{self.done} of {self.total} done, {len(self.running)} running, {self.failed} failed, {stopped}"
            f"{self.left()} left"
        )

    def table(self):
        """The counts as lines of the live table. The per cent are those of cases that are done, rounded down."""
        named = ", ".join(str(number) for number in self.running[:MOST_NAMED])
        more = ", …" if len(self.running) > MOST_NAMED else ""
        percent = 100 * self.done // max(self.total, 1)
        return [
            f"done     {self.done:>9} of {self.total}  ({percent} %)",
            f"running  {len(self.running):>9}" + (f"  case {named}{more}" if named else ""),
            f"failed   {self.failed:>9}",
            f"left     {self.left():>9}",
        ]


def clock(seconds):
    """A duration [s], rounded to seconds, as h:mm:ss, or m:ss below an hour."""
    minutes, seconds = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02d}:{seconds:02d}" if hours else f"{minutes}:{seconds:02d}"


class Display:
    """Shows counts on stderr, and messages between them. On a terminal the table is drawn again in its place.
    Otherwise, as in a log, a line is printed. If it is quiet, only messages are printed."""

    def __init__(self, is_quiet):
        """`shown` is the time of the last output by time.monotonic() [s], `lines` the number of lines of the table to
        draw over, 0 if there is none."""
        self.is_live = sys.stderr.isatty() and not is_quiet
        self.is_quiet, self.shown, self.lines = is_quiet, 0.0, 0

    def show(self, counts, at_once=False):
        """Shows the counts, unless the last output is newer than the pause allows. `at_once` shows them in any case,
        for the last output of a command. If the display is quiet, nothing is shown in any case."""
        pause = LIVE_PAUSE if self.is_live else LINE_PAUSE
        if self.is_quiet or (not at_once and time.monotonic() - self.shown < pause):
            return
        self.shown = time.monotonic()
        if not self.is_live:
            print(counts.line(), file=sys.stderr, flush=True)
            return
        rows = counts.table()
        text = "".join(f"{row}{CLEAR_LINE}\n" for row in rows)
        print(self.back() + text, end="", file=sys.stderr, flush=True)
        self.lines = len(rows)

    def back(self):
        """The control sequence that moves the cursor to the first line of the table; empty if there is no table."""
        return f"\r\033[{self.lines}A" if self.lines else ""

    def message(self, words):
        """Prints a line in the place of the table, also if the display is quiet. On a terminal the next show() draws
        the table below it at once; in a log it waits as usual."""
        print(f"{self.back()}{words}{CLEAR_LINE if self.is_live else ''}", file=sys.stderr, flush=True)
        self.shown, self.lines = 0.0 if self.is_live else self.shown, 0
