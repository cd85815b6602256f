/// Frames of volumes with half levers: what ties their rotations to the material.

#include <gtest/gtest.h>

#include <cmath>

#include "../../base/differences.h"
#include "../../base/eigenvalues.h"
#include "../../force/room.h"
#include "frames_sample.h"
#include "tissu/base/error.h"

namespace tissu {
namespace {

using test::FramesSample;
using test::view;

/// No law resists a turn of the frames alone, all by the same angle; the tie to the material does, by
/// G sin^2 per volume.
TEST(HalfLevers, TieRotationsToTheMaterial) {
  const double angle = 0.4;
  for (const std::string element : {"tetra", "hexahedron", "wedge", "pyramid"}) {
    const FramesSample sample({element, "stvk", "full", "whole", "half"});
    ElasticBlock block = sample.block();
    block.parameters = {{"young", {2.6}}, {"poisson", {0.3}}};
    const Frames model(block, sample.rest(), choose_isa(), Threads(1));
    State state = sample.rest_state();
    for (Quaternion& q : state.rotations)
      q = Quaternion(Eigen::AngleAxisd(angle, Vec3(1.0, 2.0, -2.0) / 3.0));
    double volume = 0.0;
    for (const double v : model.volumes()) volume += v;
    const double wanted = volume * std::sin(angle) * std::sin(angle);
    EXPECT_NEAR(model.energy(state, test::scratch()), wanted, 1e-12 * wanted);
  }
}

/// The matrix of a free cell has six motions without stiffness, those of a rigid body: none that a point does
/// not feel, as with whole levers. One tetrahedron or pyramid alone has too few points for that.
TEST(HalfLevers, LeaveOnlyRigidMotionsFree) {
  for (const std::string element : {"hexahedron", "wedge"}) {
    const FramesSample sample({element, "stvk", "full", "whole", "half"});
    const Frames model = sample.model();
    const State rest = sample.rest_state();
    const auto n = static_cast<Eigen::Index>(rest.positions.size());
    Eigen::MatrixXd K(n, n);
    for (Eigen::Index c = 0; c < n; ++c) {
      std::vector<double> unit(rest.positions.size(), 0.0);
      std::vector<double> column(rest.positions.size(), 0.0);
      unit[static_cast<std::size_t>(c)] = 1.0;
      model.add_product(rest, test::scratch(), {-1.0, 0.0}, unit, column);
      K.col(c) = view(column);
    }
    const Eigen::VectorXd values = test::eigenvalues(K);
    EXPECT_LE(std::abs(values[5]), 1e-10 * values[n - 1]) << element;
    EXPECT_GE(values[6], 1e-4 * values[n - 1]) << element;
  }
}

TEST(HalfLevers, RefuseWhatBendsByItself) {
  for (const std::string element : {"tetra10", "hexahedron20"}) {
    const FramesSample sample({element, "stvk", "full", "whole", "half"});
    EXPECT_THROW((void)sample.model(), ParameterError);
  }
}

}  // namespace
}  // namespace tissu
