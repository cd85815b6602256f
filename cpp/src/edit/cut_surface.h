#pragma once

/// The surface of a body for contact once blades have met it.

#include <cstdint>
#include <string>
#include <vector>

#include "edit/cut/kerf.h"
#include "tissu/edit/cut/hosts.h"
#include "tissu/world/description.h"

namespace tissu {

/// The border of its material, cut faces included; all of it in a sheet, and the pieces of lines. In a body
/// that meets itself the walls of cuts stand as far apart at rest as its surfaces rest apart, so that walls
/// that are pressed together at once have a side.
SurfaceDescription cut_surface(const BodyDescription& body, const ContactDescription& contact);

/// The same of a body of volumes alone, of what kerf_surface gives.
SurfaceDescription volume_surface(const std::string& body, const Hosts& hosts, KerfSurface found);

/// How far the walls of cuts stand inside their material [m]: so far apart they rest a gap apart. 0 in a body
/// that does not meet itself.
double kerf_depth(const std::string& body, const ContactDescription& contact);

/// Nodes that a cut made meet what those meet that they copy. They follow each other from `first` on, and
/// `points` are the places on the first day of those on edges.
void part_pairs(ContactDescription& contact, const std::string& body, std::int32_t first,
                const std::vector<std::int32_t>& copied, const std::vector<FirstDayPoint>& points);

/// Refuses cells whose faces a cut would make flat.
void refuse_curved(const BodyDescription& body);

}  // namespace tissu
