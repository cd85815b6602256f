/// Local models, the patch that a tick makes of one, and the solver.

#include "haptic/properties.h"
#include "tissu/haptic/coupling.h"
#include "tissu/haptic/patch_solver.h"
#include "tissu/haptic/tick.h"

namespace tissu::haptic::bind {
namespace {

void require_shape(const Doubles& array, std::vector<py::ssize_t> shape, const char* name) {
  const bool same = array.ndim() == static_cast<py::ssize_t>(shape.size()) &&
                    std::equal(shape.begin(), shape.end(), array.shape());
  if (same) return;
  std::string text;
  for (const py::ssize_t n : shape) text += (text.empty() ? "" : ", ") + std::to_string(n);
  throw ParameterError(std::string(name) + " must have the shape (" + text + ").");
}

Vec3 row(const Doubles& array, py::ssize_t i) {
  const double* at = array.data() + 3 * i;
  return {at[0], at[1], at[2]};
}

LocalModel make_model(std::uint64_t stamp, std::uint64_t tag, const Doubles& q_ref, const Doubles& l,
                      const Doubles& anchor, const Doubles& normal, const Doubles& tangent,
                      const Doubles& friction, const Doubles& force, const Doubles& W) {
  LocalModel model;
  model.stamp = stamp;
  model.tag = tag;
  model.q_ref = to_matrix<Joints>(q_ref, "q_ref");
  const py::ssize_t n = l.ndim() > 0 ? l.shape(0) : 0;
  if (n > kMaxContacts) {
    throw ParameterError("A local model has at most " + std::to_string(kMaxContacts) + " contacts; " +
                         std::to_string(n) + " were given.");
  }
  require_shape(l, {n, 3}, "l");
  require_shape(anchor, {n, 3}, "anchor");
  require_shape(normal, {n, 3}, "normal");
  require_shape(tangent, {n, 3}, "tangent");
  require_shape(friction, {n}, "friction");
  require_shape(force, {n, 3}, "force");
  require_shape(W, {3 * n, 3 * n}, "W");
  model.contacts = static_cast<std::int32_t>(n);
  for (py::ssize_t i = 0; i < n; ++i) {
    model.contact[static_cast<std::size_t>(i)] = {row(l, i),       row(anchor, i),     row(normal, i),
                                                  row(tangent, i), friction.data()[i], row(force, i)};
  }
  for (py::ssize_t i = 0; i < 3 * n; ++i) {
    for (py::ssize_t j = 0; j < 3 * n; ++j) model.W(i, j) = W.data()[i * 3 * n + j];
  }
  return model;
}

void set_blade(LocalModel& model, const Doubles& l, const Doubles& way, const Doubles& anchor,
               double compliance, double limit) {
  model.blade = {true,
                 to_matrix<Vec3>(l, "l"),
                 to_matrix<Vec3>(way, "way"),
                 to_matrix<Vec3>(anchor, "anchor"),
                 compliance,
                 limit};
}

/// G (n, 4), b (n,), A (n, n) of the rows of a model and its stops.
py::tuple patch_of(const LocalModel& model, const Settings& s, const Doubles& joints) {
  const Joints q = to_matrix<Joints>(joints, "q");
  const ModelRows rows = model_rows(TrocarKinematics(), model);
  Patch patch;
  make_patch(model, rows, s.joints, s.stiffness, q, Rows::Zero(), patch);
  return py::make_tuple(to_array(rows.G.topRows(rows.rows)), to_array(patch.b.head(patch.rows).eval()),
                        to_array(patch.A.topLeftCorner(patch.rows, patch.rows)));
}

/// The forces of b + A lambda; kinds "cone" (3 rows), "push", "bounded", in the order of the rows.
py::tuple solve(const Doubles& A, const Doubles& b, const std::vector<std::string>& kinds,
                const std::vector<double>& bounds, const Doubles& start, int sweeps, double tolerance) {
  Patch patch;
  patch.rows = static_cast<int>(b.size());
  patch.blocks = static_cast<int>(kinds.size());
  if (patch.rows > kMaxRows || patch.blocks > kMaxBlocks || bounds.size() != kinds.size()) {
    throw ParameterError("A patch has at most " + std::to_string(kMaxRows) + " rows and " +
                         std::to_string(kMaxBlocks) + " blocks, each with a bound.");
  }
  require_shape(b, {patch.rows}, "b");
  require_shape(start, {patch.rows}, "start");
  require_shape(A, {patch.rows, patch.rows}, "A");
  int at = 0;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const bool cone = kinds[i] == "cone";
    if (!cone && kinds[i] != "push" && kinds[i] != "bounded") {
      throw ParameterError("The kind of a block is '" + kinds[i] + "'; cone, push and bounded are accepted.");
    }
    patch.block[i] = {cone                 ? BlockKind::cone
                      : kinds[i] == "push" ? BlockKind::push
                                           : BlockKind::bounded,
                      at, bounds[i]};
    at += cone ? 3 : 1;
  }
  if (at != patch.rows)
    throw ParameterError("The blocks have " + std::to_string(at) + " rows, b another number.");
  Rows lambda = Rows::Zero();
  for (int i = 0; i < patch.rows; ++i) {
    patch.b[i] = b.data()[i];
    lambda[i] = start.data()[i];
    for (int j = 0; j < patch.rows; ++j) patch.A(i, j) = A.data()[i * patch.rows + j];
  }
  const PatchReport report = solve_patch(patch, {sweeps, tolerance}, lambda);
  return py::make_tuple(to_array(lambda.head(patch.rows).eval()), report.sweeps, report.change);
}

}  // namespace

void bind_local_model(py::module_& m) {
  using py::arg;
  py::class_<LocalModel> bound(m, "LocalModel");
  bound
      .def(py::init(&make_model), py::kw_only(), arg("stamp"), arg("tag"), arg("q_ref"), arg("l"),
           arg("anchor"), arg("normal"), arg("tangent"), arg("friction"), arg("force"), arg("W"))
      .def("set_blade", &set_blade, py::kw_only(), arg("l"), arg("way"), arg("anchor"), arg("compliance"),
           arg("limit"))
      .def("check", [](const LocalModel& model) { check(model); })
      .def("settle_compliance", [](LocalModel& model) { settle_compliance(model); })
      .def_property_readonly("contacts", [](const LocalModel& model) { return model.contacts; });
  number_property(bound, "stamp", TISSU_AT(stamp));
  number_property(bound, "tag", TISSU_AT(tag));
  number_property(bound, "time_ns", TISSU_AT(time_ns));
  m.def("patch_of", &patch_of, arg("model"), arg("settings"), arg("q"));
  m.def("solve_patch", &solve, py::kw_only(), arg("A"), arg("b"), arg("kinds"), arg("bounds"), arg("start"),
        arg("sweeps") = 30, arg("tolerance") = 1e-6);
}

}  // namespace tissu::haptic::bind
