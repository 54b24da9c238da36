"""Progress of a study on stderr: a live table on a terminal, otherwise a line now and then."""
import dataclasses
import sys
import time

MOST_NAMED = 12  # number of running cases that the table lists
LIVE_PAUSE, LINE_PAUSE = 0.2, 10.0  # times between updates of the table, and between lines [s]
CLEAR_LINE = "\033[K"


@dataclasses.dataclass
class Counts:
    """Progress of a study."""

    total: int
    done: int = 0
    failed: int = 0
    stopped: int = 0
    running: list = dataclasses.field(default_factory=list)  # numbers of cases
    before: int = 0  # number of cases that had ended before this command
    began: float = dataclasses.field(default_factory=time.monotonic)

    def left(self):
        """Remaining time at the average rate so far, in hours, minutes and seconds; a dash before the first case has
        ended."""
        ended = self.done + self.failed - self.before
        if ended <= 0:
            return "–"
        return clock((self.total - self.done - self.failed) * (time.monotonic() - self.began) / ended)

    def line(self):
        stopped = f"{self.stopped} stopped, " if self.stopped else ""
        return (
            f"{self.done} of {self.total} done, {len(self.running)} running, {self.failed} failed, {stopped}"
            f"{self.left()} left"
        )

    def table(self):
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
    minutes, seconds = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02d}:{seconds:02d}" if hours else f"{minutes}:{seconds:02d}"


class Display:
    """Shows counts on stderr, and messages between them."""

    def __init__(self, is_quiet):
        self.is_live = sys.stderr.isatty() and not is_quiet
        self.is_quiet, self.shown, self.lines = is_quiet, 0.0, 0

    def show(self, counts, at_once=False):
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
        """Moves the cursor to the first line of the table."""
        return f"\r\033[{self.lines}A" if self.lines else ""

    def message(self, words):
        """Prints a line above the table, which is drawn again below it."""
        print(f"{self.back()}{words}{CLEAR_LINE if self.is_live else ''}", file=sys.stderr, flush=True)
        self.shown, self.lines = 0.0 if self.is_live else self.shown, 0
