// Meshes of signed distance fields: limbs that blend into one body without seams.
#pragma once

#include "scene/scene.h"

#include <functional>

namespace rigel::tools {

using DistanceField = std::function<float(glm::vec3)>;

/// Closed mesh of field = 0 within the box (which must contain the surface), about one quad per `cell`^2 of surface.
/// Naive surface nets (S. Gibson, "Constrained Elastic Surface Nets", 1998), vertices then pulled onto the surface;
/// normals are the field's gradient. `field` must be
/// near a distance: no steeper than 1, no flatter than 1/2 of it around the surface.
Primitive meshImplicit(const DistanceField& field, glm::vec3 boxMin, glm::vec3 boxMax, float cell);

/// The same with normals from another field, of which this one is a part.
Primitive meshImplicit(const DistanceField& field, glm::vec3 boxMin, glm::vec3 boxMax, float cell,
                       const DistanceField& normalField);

/// Distance to a sphere-swept segment whose radius changes from ra at a to rb at b.
float roundConeDistance(glm::vec3 p, glm::vec3 a, glm::vec3 b, float ra, float rb);

/// Ellipsoid about `centre`; exact on the surface, first order around it.
float ellipsoidDistance(glm::vec3 p, glm::vec3 centre, glm::vec3 radii);

/// Union whose seam is rounded over about `blend` metres (quadratic blend); plain min where the two are farther apart.
float smoothUnion(float a, float b, float blend);

}  // namespace rigel::tools
