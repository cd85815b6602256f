#pragma once

/// The surface of a body for contact once blades have met it.

#include "tissu/world/description.h"

namespace tissu {

/// The border of its material, cut faces included; all of it in a sheet, and the pieces of lines. In a body
/// that meets itself the walls of cuts stand as far apart at rest as its surfaces rest apart, so that walls
/// that are pressed together at once have a side.
SurfaceDescription cut_surface(const BodyDescription& body, const ContactDescription& contact);

/// Nodes that a cut made meet what those meet that they copy.
void part_pairs(ContactDescription& contact, const BodyDescription& body,
                const std::vector<std::int32_t>& copied);

/// Refuses sheets and lines that meet themselves, and a flat body, of which only the rim is in contact.
void refuse_touching(const BodyDescription& body, const SurfaceDescription& surface,
                     const ContactDescription& contact);

/// Refuses cells whose faces a cut would make flat.
void refuse_curved(const BodyDescription& body);

}  // namespace tissu
