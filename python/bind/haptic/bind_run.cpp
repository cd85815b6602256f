#include "haptic/settings.h"
#include "tissu/haptic/loop.h"
#include "tissu/haptic/run.h"

namespace tissu::haptic::bind {
namespace {

/// A run and its loop, which is there while it runs in real time.
class Running {
 public:
  Running(std::shared_ptr<Device> device, const py::dict& settings, std::size_t room)
      : settings_(checked(settings, *device)), run_(std::move(device), settings_, room) {}

  void set(const py::dict& changes, double delay) {
    py::dict fields = to_dict(settings_);
    for (const auto& [key, value] : changes) fields[key] = value;
    const Settings next = settings_of(fields);
    check(next, delay);
    settings_ = next;
    run_.set(next);
  }
  [[nodiscard]] py::dict settings() const { return to_dict(settings_); }

  py::dict step(std::int64_t ticks) {
    if (loop_ && loop_->report().running) {
      throw Error("the trocar runs in real time; stop it before it is stepped.");
    }
    {
      const py::gil_scoped_release unlocked;
      for (std::int64_t k = 0; k < ticks; ++k) run_.step();
    }
    return to_dict(run_.report());
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

  std::uint64_t publish(const LocalModel& model) noexcept { return run_.publish(model); }
  py::dict report() { return to_dict(run_.report()); }
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
  static Settings checked(const py::dict& fields, const Device& device) {
    const Settings settings = settings_of(fields);
    check(settings, device.info().delay);
    return settings;
  }

  Settings settings_;
  Run run_;
  std::unique_ptr<Loop> loop_;
};

/// Row k of an array (n, 3).
Vec3 row(const Doubles& array, std::size_t k, std::size_t rows, const char* name) {
  if (array.ndim() != 2 || array.shape(0) != static_cast<py::ssize_t>(rows) || array.shape(1) != 3) {
    throw ParameterError(std::string(name) + " must have the shape (" + std::to_string(rows) + ", 3).");
  }
  return {array.data()[3 * k], array.data()[3 * k + 1], array.data()[3 * k + 2]};
}

/// The arrays of a local model.
struct ModelArrays {
  Doubles points, anchors, normals, tangents, friction, forces, compliance, joints;
};

LocalModel model_of(const ModelArrays& arrays, std::uint64_t tag) {
  LocalModel model;
  const auto count = static_cast<std::size_t>(arrays.friction.size());
  if (count > static_cast<std::size_t>(kMaxContacts)) {
    throw ParameterError("found " + std::to_string(count) + " contacts; at most " + std::to_string(kMaxContacts) +
                         " are accepted: keep those of the smallest gaps.");
  }
  const auto rows = static_cast<py::ssize_t>(3 * count);
  const Doubles& W = arrays.compliance;
  if (W.ndim() != 2 || W.shape(0) != rows || W.shape(1) != rows) {
    throw ParameterError("compliance must have the shape (" + std::to_string(rows) + ", " + std::to_string(rows) + ").");
  }
  model.contacts = static_cast<std::int32_t>(count);
  model.tag = tag;
  model.q_ref = to_matrix<Joints>(arrays.joints, "joints");
  for (std::size_t k = 0; k < count; ++k) {
    model.contact[k] = {row(arrays.points, k, count, "points"),     row(arrays.anchors, k, count, "anchors"),
                        row(arrays.normals, k, count, "normals"),   row(arrays.tangents, k, count, "tangents"),
                        arrays.friction.data()[k],                  row(arrays.forces, k, count, "forces")};
  }
  for (py::ssize_t i = 0; i < rows; ++i) {
    for (py::ssize_t j = 0; j < rows; ++j) {
      model.W(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = W.data()[i * rows + j];
    }
  }
  return model;
}

/// Adds the row of a blade: its point, way and anchor, compliance and limit.
void add_blade(LocalModel& model, const py::tuple& blade) {
  model.blade.present = true;
  model.blade.l = to_matrix<Vec3>(blade[0].cast<Doubles>(), "the blade's point");
  model.blade.way = to_matrix<Vec3>(blade[1].cast<Doubles>(), "the blade's way");
  model.blade.anchor = to_matrix<Vec3>(blade[2].cast<Doubles>(), "the blade's anchor");
  model.blade.compliance = blade[3].cast<double>();
  model.blade.limit = blade[4].cast<double>();
}

std::uint64_t publish(Running& run, const Doubles& points, const Doubles& anchors, const Doubles& normals,
                      const Doubles& tangents, const Doubles& friction, const Doubles& forces,
                      const Doubles& compliance, const Doubles& joints, std::uint64_t tag,
                      const std::optional<py::tuple>& blade, bool unchecked) {
  LocalModel model =
      model_of({points, anchors, normals, tangents, friction, forces, compliance, joints}, tag);
  if (blade) add_blade(model, *blade);
  if (!unchecked) check(model);
  settle_compliance(model);
  return run.publish(model);
}

}  // namespace

void bind_run(py::module_& m) {
  using py::arg;
  const auto unlocked = py::call_guard<py::gil_scoped_release>();
  py::class_<Running>(m, "Run")
      .def(py::init<std::shared_ptr<Device>, const py::dict&, std::size_t>(), arg("device"), arg("settings"),
           py::kw_only(), arg("room") = 4096)
      .def("set", &Running::set, arg("changes"), py::kw_only(), arg("delay"))
      .def("settings", &Running::settings)
      .def("step", &Running::step, arg("ticks") = 1)
      .def("start", &Running::start, py::kw_only(), arg("priority"), arg("lock_memory"), arg("pin"), arg("spin"),
           unlocked)
      .def("stop", &Running::stop, unlocked)
      .def("end", &Running::end)
      .def("publish", &publish, py::kw_only(), arg("points"), arg("anchors"), arg("normals"), arg("tangents"),
           arg("friction"), arg("forces"), arg("compliance"), arg("joints"), arg("tag"),
           arg("blade") = py::none(), arg("unchecked") = false)
      .def("report", &Running::report)
      .def("records", &Running::records)
      .def("lost_records", &Running::lost_records)
      .def("timing", &Running::timing);
}

}  // namespace tissu::haptic::bind
