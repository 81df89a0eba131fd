// Procedural pictures for the faces of the simulated room: reflectance, linear red, green, blue from 0 to 1, at a point in metres.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace arift::synthetic::paint
{

/// `p`: world coordinates along the face's first and second axis (scene.h). Pure.
using Paint = glm::vec3 (*)(glm::vec2 p);

// The shell of the room
glm::vec3 floorboards(glm::vec2 p);
glm::vec3 ceiling(glm::vec2 p);
glm::vec3 frontWall(glm::vec2 p);
glm::vec3 backWall(glm::vec2 p);
glm::vec3 windowWall(glm::vec2 p); ///< brighter than 1 where daylight comes in
glm::vec3 doorWall(glm::vec2 p);

// Furniture
glm::vec3 oak(glm::vec2 p);
glm::vec3 walnut(glm::vec2 p);
glm::vec3 bookshelf(glm::vec2 p);
glm::vec3 drawers(glm::vec2 p);
glm::vec3 television(glm::vec2 p);
glm::vec3 sofaCloth(glm::vec2 p);
glm::vec3 cushion(glm::vec2 p);
glm::vec3 leaves(glm::vec2 p);
glm::vec3 clay(glm::vec2 p);
glm::vec3 metal(glm::vec2 p);
glm::vec3 lamp(glm::vec2 p); ///< brighter than 1

// Things
glm::vec3 bookCover(glm::vec2 p);
glm::vec3 pages(glm::vec2 p);
glm::vec3 radio(glm::vec2 p);
glm::vec3 mug(glm::vec2 p);
glm::vec3 colourCube(glm::vec2 p);
glm::vec3 stoolSeat(glm::vec2 p);

} // namespace arift::synthetic::paint
