// Functions that the page's worker calls (browser/page/simulator.js). Texts are passed in one buffer for each
// direction.

#include <cmath>
#include <string>

#include "browser/module/session.hpp"
#include "io/run/summary.hpp"
#include "io/scene/scene_input.hpp"

namespace {

using polynya::browser::Session;

Session& session() {
  static Session only;
  return only;
}

std::string input;   ///< text from the page
std::string output;  ///< text for the page

int answer(bool is_good, std::string words) {
  output = std::move(words);
  return is_good ? 1 : 0;
}

/// Calls work(). An exception becomes an answer, so that the page stays in its state.
template <class Work>
int guarded(Work work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return answer(false, "there is not enough memory in this page for this scene");
  } catch (const std::exception& failure) {
    return answer(false, failure.what());
  }
}

int answer_of_session(bool is_good) {
  return answer(is_good, session().words());
}

}  // namespace

extern "C" {

[[clang::export_name("input_buffer")]] char* input_buffer(std::size_t size) {
  input.resize(size);
  return input.data();
}
[[clang::export_name("output_data")]] const char* output_data() {
  return output.data();
}
[[clang::export_name("output_size")]] std::size_t output_size() {
  return output.size();
}
[[clang::export_name("columns_data")]] const char* columns_data() {
  return session().columns().data();
}
[[clang::export_name("columns_size")]] std::size_t columns_size() {
  return session().columns().size();
}

[[clang::export_name("load")]] int load() {
  return guarded([] { return answer_of_session(session().load(std::move(input))); });
}
[[clang::export_name("start")]] int start() {
  return guarded([] { return answer_of_session(session().start()); });
}
/// Returns a Progress (session.hpp), or −1 if it failed.
[[clang::export_name("advance")]] int advance(double until, double wall) {
  int progress = -1;
  guarded([&] {
    progress = static_cast<int>(session().advance(until, wall));
    return answer_of_session(true);
  });
  return progress;
}
/// Steps up to a time, also beyond the scene's end, where tests compare states.
[[clang::export_name("advance_beyond")]] int advance_beyond(double until) {
  return guarded([&] { return answer_of_session(session().advance_beyond(until)); });
}
[[clang::export_name("snapshot")]] int snapshot() {
  return guarded([] {
    if (!session().has_run()) return answer(false, "there is no run");
    session().take_snapshot();
    return answer_of_session(true);
  });
}
[[clang::export_name("steer")]] void steer(int ship, double lever, double angle) {
  session().steer(ship, {lever, angle});
}
[[clang::export_name("release")]] void release(int ship) {
  session().release(ship);
}
/// The input is the reason why the run ends; empty if it has reached the end of the scene.
[[clang::export_name("finish")]] int finish() {
  return guarded([] { return answer_of_session(session().finish(input)); });
}
[[clang::export_name("read_back")]] int read_back() {
  return guarded([] { return answer_of_session(session().read_back()); });
}
[[clang::export_name("state_hash")]] int state_hash() {
  return answer(true, session().state_hash());
}
[[clang::export_name("schema")]] int schema() {
  return guarded([] { return answer(true, polynya::io::scene_schema()); });
}
[[clang::export_name("version")]] int version() {
  return answer(true, std::string(polynya::io::version()));
}

}  // extern "C"
