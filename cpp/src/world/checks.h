#pragma once

/// What a world refuses of its description.

#include <string>
#include <vector>

#include "tissu/world/world.h"

namespace tissu {

/// Tables whose columns differ in length, and times that do not ascend.
void check_table(const std::string& where, const std::vector<double>& times, std::size_t values);
/// Lists that do not have three numbers for each node.
void check_size(const std::string& where, std::size_t found, std::size_t accepted);
/// Masses and inertias that are not positive.
/// Refuses a node that is a frame without inertia.
void check_inertia(const std::string& body, std::int32_t node, const Mat3& inertia);
void check_frame(const FrameDescription& frame, std::size_t number);
/// A node without mass would make the matrix singular, unless it is held.
void refuse_massless(const Body& body, const std::vector<double>& masses, const FixedDofs& fixed);
/// What an eliminated node may not be: another model's, held, or loaded.
void refuse_touched(const Body& body, const BodyModel& model, const WorldDescription& description,
                    const FixedDofs& fixed);

}  // namespace tissu
