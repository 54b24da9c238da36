#pragma once

#include <optional>
#include <string>

namespace polynya::app {

struct ViewOptions {
  std::string run;
  std::string out;              ///< empty: view.html in the run folder
  int every = 1;                ///< only each so many-th frame
  std::optional<double> from;   ///< [s]
  std::optional<double> until;  ///< [s]
  double most_megabytes = 100;  ///< a larger page is refused [10⁶ bytes]
};
int view(const ViewOptions& options);

}  // namespace polynya::app
