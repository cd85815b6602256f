#include <array>
#include <string>
#include <tuple>

#include "bind.h"
#include "motion.h"
#include "specs.h"
#include "tissu/edit/tissue_points.h"
#include "tissu/world/world.h"

namespace tissu::bind {
namespace {

History to_history(const Doubles& times, const Doubles& factors) {
  return {to_vector(times), to_vector(factors)};
}

using Parameters = std::map<std::string, Doubles>;

LawParameters to_parameters(const Parameters& parameters) {
  LawParameters result;
  for (const auto& [name, values] : parameters) result[name] = to_vector(values);
  return result;
}

/// What each elastic block of a world holds: body, element, law, cells, bytes, numbers per cell.
py::list elastic_blocks(const World& world) {
  py::list result;
  for (const Body& body : world.bodies()) {
    for (const BodyModel* model : body.models) {
      const ElasticBlock& block = model->block();
      result.append(py::make_tuple(body.name, block.element, block.law, model->cell_count(), model->bytes(),
                                   model->reals_per_cell()));
    }
  }
  return result;
}

/// Shape, sizes and `up` of LineSection.
using SectionOfLines = std::tuple<std::string, std::array<double, 5>, std::array<double, 3>>;

void add_elastic(WorldDescription& world, const std::string& body, const std::string& cell_type,
                 const Ints& cells, const Ints& cell_numbers, const std::string& law,
                 const Parameters& parameters, const Doubles& density, const std::string& quadrature,
                 const std::vector<std::pair<std::string, Parameters>>& reinforcements,
                 const std::shared_ptr<LoadedLaw>& loaded, const Doubles& cross_section,
                 const SectionOfLines& section, Plane plane, const ModelSpec& model) {
  ElasticBlock block;
  block.element = cell_type;
  block.law = law;
  block.loaded = loaded;
  block.quadrature = quadrature;
  block.cells = to_vector(cells);
  block.cell_numbers = to_vector(cell_numbers);
  if (cells.ndim() != 2 || cell_numbers.size() != cells.shape(0)) {
    throw ParameterError("cells must have the shape (e, k), and cell_numbers the shape (e,).");
  }
  block.parameters = to_parameters(parameters);
  for (const auto& [added, values] : reinforcements)
    block.reinforcements.push_back({added, to_parameters(values)});
  block.density = to_vector(density);
  block.cross_section = to_vector(cross_section);
  const auto& [shape, sizes, up] = section;
  block.section = {section_shape(shape), sizes, Vec3(up[0], up[1], up[2])};
  block.plane = plane;
  block.model = model.options;
  world.body(body).elastic.push_back(std::move(block));
}

/// Points among frames, (p, k) of each list, without the frames themselves.
FramePoints to_points(const Ints& frames, const Doubles& weights, const Doubles& gradients,
                      const Doubles& positions, const Doubles& volumes) {
  if (frames.ndim() != 2) throw ParameterError("frames must have the shape (p, k).");
  FramePoints points;
  points.neighbours = static_cast<int>(frames.shape(1));
  points.weights = to_vector(weights);
  points.gradients = to_vector(gradients);
  points.positions = to_vector(with_columns(positions, 3, "positions"));
  points.volumes = to_vector(volumes);
  return points;
}

using Shared = std::vector<std::pair<std::string, std::int32_t>>;

std::vector<SharedNode> to_shared(const Shared& shared) {
  std::vector<SharedNode> result;
  result.reserve(shared.size());
  for (const auto& [body, node] : shared) result.push_back({body, node});
  return result;
}

/// Points of a body of frames: which nodes of its own and then of `shared` each listens to, and how.
void add_points(WorldDescription& world, const std::string& body, const Shared& shared, const Ints& frames,
                const Doubles& weights, const Doubles& gradients, const Doubles& positions,
                const Doubles& volumes, const std::string& law, const Parameters& parameters,
                const Parameters& fibres, const std::shared_ptr<LoadedLaw>& loaded, double density,
                const ModelSpec& model) {
  auto points = std::make_shared<FramePoints>(to_points(frames, weights, gradients, positions, volumes));
  ElasticBlock block;
  block.element = "points";
  block.cells = to_vector(frames);
  block.law = law;
  block.loaded = loaded;
  block.parameters = to_parameters(parameters);
  if (!fibres.empty()) block.reinforcements.push_back({"fibre", to_parameters(fibres)});
  block.density = {density};
  block.model = model.options;
  std::get<FramesOptions>(block.model).points = std::move(points);
  BodyDescription& made = world.body(body);
  for (SharedNode& node : to_shared(shared)) made.shared.push_back(std::move(node));
  made.elastic.push_back(std::move(block));
}

/// The world with other points in a tissue, and those of its frames that no point follows held at `places`.
std::shared_ptr<World> points_left(const World& world, const std::string& tissue, const Shared& shared,
                                   const Ints& frames, const Doubles& weights, const Doubles& gradients,
                                   const Doubles& positions, const Doubles& volumes, const Doubles& places) {
  TissuePoints left{to_shared(shared), to_points(frames, weights, gradients, positions, volumes)};
  left.points.frames = to_vector(frames);
  const std::vector<double> at = to_vector(with_columns(places, 3, "places"));
  return std::const_pointer_cast<World>(with_points(world, tissue, std::move(left), at));
}

void add_prony(WorldDescription& world, const std::string& body,
               const std::vector<std::pair<double, double>>& branches) {
  Viscosity viscosity;
  for (const auto& [weight, time] : branches) viscosity.prony.push_back({weight, time});
  world.body(body).viscosity = std::move(viscosity);
}

std::vector<FaceCells> to_faces(const std::vector<std::pair<std::string, Ints>>& faces, double thickness) {
  std::vector<FaceCells> result;
  result.reserve(faces.size());
  for (const auto& [type, nodes] : faces) result.push_back({type, to_vector(nodes), thickness});
  return result;
}

void add_fixed(WorldDescription& world, const std::string& body, const Ints& nodes, int axes, int rotations,
               Motion motion, std::string name) {
  if (axes < 0 || axes > 7) throw ParameterError("axes must be a mask of x = 1, y = 2 and z = 4.");
  if (rotations < 0 || rotations > 7) {
    throw ParameterError("rotations must be a mask of x = 1, y = 2 and z = 4.");
  }
  world.fixed.push_back({world.body(body).name,
                         to_vector(nodes),
                         static_cast<std::uint8_t>(axes),
                         std::move(motion),
                         {},
                         static_cast<std::uint8_t>(rotations),
                         std::move(name)});
}

}  // namespace

/// Of bind_contact.cpp.
void bind_contact(py::class_<WorldDescription>& builder);

void bind_world(py::module_& m) {
  using py::arg;
  py::class_<World, std::shared_ptr<World>>(m, "World")
      .def_property_readonly("blocks", &World::blocks)
      .def_property_readonly("matrix_blocks", [](const World& world) { return world.sparsity().blocks(); })
      .def_property_readonly("elastic_blocks", &elastic_blocks)
      .def_property_readonly("editable", [](const World& world) { return world.description() != nullptr; })
      .def_property_readonly("mass", [](const World& world) { return world.mass().total(); })
      .def("with_points", &points_left, py::kw_only(), arg("tissue"), arg("shared"), arg("frames"),
           arg("weights"), arg("gradients"), arg("positions"), arg("volumes"), arg("places"))
      .def_property_readonly("threads", [](const World& world) { return world.threads().count(); })
      .def_property_readonly("instruction_set",
                             [](const World& world) { return std::string(name(world.isa())); });

  py::enum_<Plane>(m, "Plane")
      .value("free", Plane::free)
      .value("stress", Plane::stress)
      .value("strain", Plane::strain);
  py::class_<WorldDescription> builder(m, "WorldBuilder");
  bind_contact(builder);
  builder
      .def(py::init([](int threads, bool editable, bool grabbing, bool consistent_weight) {
             WorldDescription world;
             world.threads = threads;
             world.editable = editable;
             world.grabbing = grabbing;
             world.consistent_weight = consistent_weight;
             return world;
           }),
           py::kw_only(), arg("threads"), arg("editable"), arg("grabbing"), arg("consistent_weight"))
      .def(
          "add_body",
          [](WorldDescription& world, const std::string& name, const Doubles& positions, bool frames) {
            std::size_t first = 0;
            for (const BodyDescription& body : world.bodies) first += body.positions.size() / 3;
            world.bodies.push_back({name, to_vector(with_columns(positions, 3, "positions")), {}, {}});
            world.bodies.back().frames = frames;
            return first;
          },
          py::kw_only(), arg("name"), arg("positions"), arg("frames"))
      .def(
          "leave_room",
          [](WorldDescription& world, const std::string& body, std::int32_t nodes) {
            world.body(body).room = nodes;
          },
          py::kw_only(), arg("body"), arg("nodes"))
      .def(
          "use_instruments",
          [](WorldDescription& world, bool pressing) {
            world.instruments = true;
            world.pressing = pressing;
          },
          py::kw_only(), arg("pressing"))
      .def("add_elastic", &add_elastic, py::kw_only(), arg("body"), arg("cell_type"), arg("cells"),
           arg("cell_numbers"), arg("law"), arg("parameters"), arg("density"), arg("quadrature"),
           arg("reinforcements"), arg("loaded").none(true), arg("cross_section"), arg("section"),
           arg("plane"), arg("model"))
      .def("add_points", &add_points, py::kw_only(), arg("body"), arg("shared"), arg("frames"),
           arg("weights"), arg("gradients"), arg("positions"), arg("volumes"), arg("law"), arg("parameters"),
           arg("fibres"), arg("loaded").none(true), arg("density"), arg("model"))
      .def(
          "add_rayleigh",
          [](WorldDescription& world, const std::string& body, double mass, double stiffness) {
            world.body(body).rayleigh = RayleighDamping{mass, stiffness};
          },
          py::kw_only(), arg("body"), arg("mass"), arg("stiffness"))
      .def(
          "add_kelvin_voigt",
          [](WorldDescription& world, const std::string& body, double shear, double bulk) {
            Viscosity viscosity;
            viscosity.shear = shear;
            viscosity.bulk = bulk;
            world.body(body).viscosity = std::move(viscosity);
          },
          py::kw_only(), arg("body"), arg("shear"), arg("bulk"))
      .def(
          "add_centroid",
          [](WorldDescription& world, const std::string& body, double coefficient) {
            Viscosity viscosity;
            viscosity.centroid = coefficient;
            world.body(body).viscosity = std::move(viscosity);
          },
          py::kw_only(), arg("body"), arg("coefficient"))
      .def("add_prony", &add_prony, py::kw_only(), arg("body"), arg("branches"))
      .def(
          "add_gravity",
          [](WorldDescription& world, const Doubles& acceleration) {
            world.gravity = to_vec3(acceleration, "acceleration");
          },
          py::kw_only(), arg("acceleration"))
      .def(
          "add_load",
          [](WorldDescription& world, const std::string& name, const std::string& body, const Ints& nodes,
             const Doubles& forces, const Doubles& times, const Doubles& factors, bool moments,
             const std::vector<std::pair<std::string, Ints>>& faces, double thickness, const Doubles& unit,
             bool along_normals) {
            world.loads.push_back({name, world.body(body).name, to_vector(nodes),
                                   to_vector(with_columns(forces, 3, "forces")), to_history(times, factors),
                                   moments});
            LoadDescription& load = world.loads.back();
            load.faces = to_faces(faces, thickness);
            load.unit = to_vec3(unit, "unit");
            load.along_normals = along_normals;
          },
          py::kw_only(), arg("name"), arg("body"), arg("nodes"), arg("forces"), arg("times"), arg("factors"),
          arg("moments"), arg("faces"), arg("thickness"), arg("unit"), arg("along_normals"))
      .def(
          "add_pressure",
          [](WorldDescription& world, const std::string& name, const std::string& body,
             const std::vector<std::pair<std::string, Ints>>& faces, double pressure, const Doubles& times,
             const Doubles& factors, double thickness) {
            world.pressures.push_back({name, world.body(body).name, to_faces(faces, thickness), pressure,
                                       to_history(times, factors)});
          },
          py::kw_only(), arg("name"), arg("body"), arg("faces"), arg("pressure"), arg("times"),
          arg("factors"), arg("thickness"))
      .def(
          "fix",
          [](WorldDescription& world, const std::string& body, const Ints& nodes, int axes, int rotations,
             std::string name) { add_fixed(world, body, nodes, axes, rotations, {}, std::move(name)); },
          py::kw_only(), arg("body"), arg("nodes"), arg("axes"), arg("rotations"), arg("name"))
      .def(
          "prescribe",
          [](WorldDescription& world, const std::string& body, const Ints& nodes, int axes,
             const Doubles& times, const Doubles& displacements, const Doubles& angles, const Doubles& center,
             const Doubles& axis, int rotations, std::string name) {
            add_fixed(world, body, nodes, axes, rotations,
                      to_motion(times, displacements, angles, center, axis), std::move(name));
          },
          py::kw_only(), arg("body"), arg("nodes"), arg("axes"), arg("times"), arg("displacements"),
          arg("angles"), arg("center"), arg("axis"), arg("rotations"), arg("name"))
      .def(
          "build", [](const WorldDescription& world) { return std::make_shared<World>(world); },
          py::call_guard<py::gil_scoped_release>())
      .def(
          "build_crossing",
          [](const WorldDescription& world) {
            if (!world.contact) return std::make_shared<World>(world);
            WorldDescription crossing = world;  // in which surfaces may cross, and are left where they are
            crossing.contact->travel = false;
            const World before(std::move(crossing));
            return std::make_shared<World>(world, &before);
          },
          py::call_guard<py::gil_scoped_release>());
}

}  // namespace tissu::bind
