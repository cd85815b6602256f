#pragma once

/// Divided cells become as many cells as their material has tetrahedra.
///
/// Vertices on edges become nodes. Each cell has the gradient F of the one that it comes from, because x is
/// linear in that: so the elastic energy stays, whatever the law. Masses at the nodes are those of the new
/// cells: mass and momentum stay, and the kinetic energy never rises.

#include "edit/cut/incisions.h"
#include "edit/cut/patch.h"
#include "tissu/edit/cut/cut_plan.h"
#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/material.h"

namespace tissu {

/// Refuses cells that are not tetrahedra or triangles of first order, and cells of which a copy holds a part.
void refuse_undivided(const Hosts& hosts, const Material& material, const std::vector<std::int32_t>& cells);

/// Cells, nodes and material of the plan; the patch has divided edges and opened faces. The nodes of opened
/// faces part by their fans. Whether one parts.
bool write_division(const Hosts& hosts, const Material& material, ConstReals x, const Patch& patch,
                    const OnIncisions& met, CutPlan& plan);

}  // namespace tissu
