#pragma once

namespace polynya::app {

/// From now on SIGINT, SIGTERM and SIGHUP only ask to stop (a second one ends the program at once), and a
/// write past a size limit or into a closed pipe is an error where it happens, not a signal.
void watch_signals();

/// The signal that asked to stop, or 0.
int stop_signal();

}  // namespace polynya::app
