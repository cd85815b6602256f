#include <memory>
#include <utility>

#include "haptic/records.h"
#include "haptic/rows.h"
#include "tissu/haptic/loop.h"
#include "tissu/haptic/run.h"

namespace tissu::haptic::bind {
namespace {

/// A run and its loop, which is there while it runs in real time. The device is the caller's.
class Running {
 public:
  Running(Device& device, const Settings& settings, std::size_t room)
      : settings_(checked(settings, device.info().delay)), run_(device, settings, room) {}

  void set(const Settings& settings, double delay) {
    settings_ = checked(settings, delay);
    run_.set(settings_, ++changes_);
  }

  /// Of a recording, which has the number.
  void set_numbered(const Settings& settings, std::uint32_t number) { run_.set(settings, number); }

  py::dict step(std::int64_t ticks, std::int64_t late) {
    if (loop_ && loop_->report().running) {
      throw Error("the trocar runs in real time; stop it before it is stepped.");
    }
    {
      const py::gil_scoped_release unlocked;
      for (std::int64_t k = 0; k < ticks; ++k) run_.step(k == 0 ? late : 0);
    }
    return report();
  }
  void start(int priority, bool lock_memory, bool pin, double spin) {
    if (loop_ && loop_->report().running) throw Error("the trocar runs in real time already; stop it first.");
    loop_.reset();
    run_.begin();
    loop_ = std::make_unique<Loop>(run_, LoopOptions{settings_.period, priority, lock_memory, pin, spin});
    loop_->start();
  }
  void stop() {
    if (loop_) loop_->stop();
  }
  void end() noexcept { run_.end(); }

  void publish(LocalModel& model) noexcept { run_.publish(model); }
  void offer(const LocalModel& model) noexcept { run_.offer(model); }
  py::dict report() { return to_dict(run_.report(), {}); }
  py::dict records() { return to_columns(run_.take_records()); }
  [[nodiscard]] std::int64_t lost_records() const { return run_.lost_records(); }

  [[nodiscard]] py::dict timing() const {
    py::dict made;
    made["read"] = to_dict(run_.read_timing());
    made["write"] = to_dict(run_.write_timing());
    made["model_age"] = to_dict(run_.model_age());
    const LoopReport loop = loop_ ? loop_->report() : LoopReport{};
    made["running"] = loop.running;
    made["ticks"] = loop.ticks;
    made["missed"] = loop.missed;
    made["held"] = loop.held;
    made["lateness"] = to_dict(loop.lateness);
    made["compute"] = to_dict(loop.compute);
    py::list grants;
    for (const Grant& grant : loop.grants) {
      grants.append(py::make_tuple(grant.what, grant.granted, grant.error, grant.remedy));
    }
    made["grants"] = grants;
    return made;
  }

 private:
  static Settings checked(Settings settings, double delay) {
    check(settings, delay);
    return settings;
  }

  Settings settings_;
  std::uint32_t changes_ = 0;
  Run run_;
  std::unique_ptr<Loop> loop_;
};

}  // namespace

void bind_run(py::module_& m) {
  using py::arg;
  const auto unlocked = py::call_guard<py::gil_scoped_release>();
  py::class_<Running>(m, "Run")
      .def(py::init<Device&, const Settings&, std::size_t>(), arg("device"), arg("settings"), py::kw_only(),
           arg("room") = 4096, py::keep_alive<1, 2>())
      .def("set", &Running::set, arg("settings"), py::kw_only(), arg("delay"))
      .def("set_numbered", &Running::set_numbered, arg("settings"), arg("number"))
      .def("step", &Running::step, arg("ticks") = 1, py::kw_only(), arg("late") = 0)
      .def("start", &Running::start, py::kw_only(), arg("priority"), arg("lock_memory"), arg("pin"),
           arg("spin"), unlocked)
      .def("stop", &Running::stop, unlocked)
      .def("end", &Running::end)
      .def("publish", &Running::publish, arg("model"))
      .def("offer", &Running::offer, arg("model"))
      .def("report", &Running::report)
      .def("records", &Running::records)
      .def("lost_records", &Running::lost_records)
      .def("timing", &Running::timing);
  m.attr("ANY_TOOL") = kAnyTool;
}

}  // namespace tissu::haptic::bind
