#include "bind.h"
#include "tissu/simulation/compliance.h"

namespace tissu::bind {
namespace {

ComplianceWay way_named(const std::string& name) {
  if (name == "factor") return ComplianceWay::factor;
  if (name == "cg") return ComplianceWay::gradient;
  if (name == "condensed") return ComplianceWay::condensed;
  if (name == "warped") return ComplianceWay::warped;
  throw ParameterError("found the way \"" + name + "\"; factor, cg, condensed and warped are accepted.");
}

/// Points of which number i has the parts [begin[i], begin[i + 1]).
std::vector<CarriedPoint> to_points(const Array<std::int32_t>& begin, const Array<std::int32_t>& rows,
                                    const Array<double>& weights, const Array<double>& axes,
                                    std::int32_t row_count) {
  const auto count = static_cast<std::size_t>(begin.size()) - 1;
  if (axes.size() != static_cast<py::ssize_t>(9 * count) || rows.size() != weights.size() ||
      begin.data()[count] != rows.size()) {
    throw ParameterError("points, their rows, weights and axes do not fit each other.");
  }
  std::vector<CarriedPoint> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::int32_t k = begin.data()[i]; k < begin.data()[i + 1]; ++k) {
      const std::int32_t row = rows.data()[k];
      if (row < 0 || row >= row_count) throw ParameterError("found a row that this world does not have.");
      points[i].parts.push_back({row, weights.data()[k]});
    }
    points[i].axes = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(axes.data() + 9 * i);
  }
  return points;
}

}  // namespace

void bind_compliance(py::module_& m) {
  using py::arg;
  m.def("factor_library", [] { return std::string(Compliance::library()); });
  py::class_<Compliance>(m, "Compliance")
      .def(py::init([](const std::string& way, double tolerance, const Array<std::int32_t>& rows) {
             return std::make_unique<Compliance>(
                 Compliance::Settings{way_named(way), tolerance, to_vector(rows)});
           }),
           py::kw_only(), arg("way"), arg("tolerance"), arg("rows"))
      .def(
          "find",
          [](Compliance& self, Simulation& simulation, double dt, const Array<std::int32_t>& begin,
             const Array<std::int32_t>& rows, const Array<double>& weights, const Array<double>& axes) {
            const std::vector<CarriedPoint> points =
                to_points(begin, rows, weights, axes, simulation.world().blocks());
            const Eigen::MatrixXd& W = self.find(simulation, dt, points);
            const auto size = static_cast<py::ssize_t>(W.rows());
            return py::array_t<double>({size, size}, W.data());  // symmetric: the order does not matter
          },
          py::kw_only(), arg("simulation"), arg("dt"), arg("begin"), arg("rows"), arg("weights"), arg("axes"))
      .def_property_readonly("drift",
                             [](const Compliance& self) {
                               const Eigen::VectorXd& d = self.drift();
                               return py::array_t<double>(static_cast<py::ssize_t>(d.size()), d.data());
                             })
      .def_property_readonly("error", [](const Compliance& self) { return self.report().error; })
      .def_property_readonly("corrections", [](const Compliance& self) { return self.report().corrections; })
      .def_property_readonly("made", [](const Compliance& self) { return self.report().made; })
      .def_property_readonly("definite", [](const Compliance& self) { return self.report().definite; });
}

}  // namespace tissu::bind
