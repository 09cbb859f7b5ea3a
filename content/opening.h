#pragma once
// Doors, windows and arches in walls of Blocks: outlines, splayed reveals, the wall's flush rest around the head,
// mouldings and tracery.
#include "content/blocks.h"

namespace daylit::content {

enum class Head { Flat, Segmental, Round, Pointed };

/// The way a wall's outer face looks.
enum class Facing { North, East, South, West };

/// Closed outline in the wall's plane, counter-clockwise seen from outside: bottom left, bottom right, then over the
/// head from the right springing to the left. x runs to the right seen from outside, y up. All outlines have the same
/// number of points, so that any two can be joined. Convex.
std::vector<Vec2> outline(Head head, float width, float bottom, float spring);
float head_height(Head head, float width);
/// A circle that starts at its lowest point with a very short "bottom".
std::vector<Vec2> circle_outline(float radius, float centre_y);

struct Loop {
    float depth;  // metres behind the outer face; 0 the outer face, the wall's thickness the inner
    std::vector<Vec2> points;
};

struct Opening {
    Vec3 origin;  // on the outer face: the zero of the outlines
    Facing facing = Facing::South;
    float thickness = 1.0f;
    std::vector<Loop> loops;             // from the outer face to the inner
    int room = 0;                        // whose air fills it
    int outer_wall = 0, inner_wall = 0;  // materials of the flush rest of the wall
    int reveal = 0, sill = 0;            // materials of the sides and head, and of the bottom
    bool open_bottom = false;            // no sill surface: the air goes on below (arches on columns)
};

/// Wall frame: +X along the wall, +Y up, +Z outwards, zero at the opening's origin.
Mat4 wall_frame(const Opening& opening);

/// Cuts the wall and adds reveal and flush rests to the builder.
void add_opening(Blocks& blocks, MeshBuilder& builder, const Opening& opening);

/// A sheet a little behind the flush rest of the inner face and wider: rest and wall share no vertices along their
/// seam, and through the hair cracks that rasterisers leave there the sky would shine into a dim room.
void back_inner_seam(MeshBuilder& builder, const Opening& opening);

/// A moulded frame `width` wide around an outline, standing `rise` out of the outer face (depth 0) or, with inside set,
/// out of the inner face; ends in the floor or sill at the bottom.
void add_surround(MeshBuilder& builder, const Opening& opening, bool inside, float width, float rise, int material);

/// Mullions, transoms and head tracery of round bars in the plane at `depth`, and a sheet filling it: one, or where it
/// has a thickness, a face to either side, so that each has the light of its own side.
struct Tracery {
    float depth = 0.3f;
    int lights = 2;  // panes side by side
    int transoms = 2;
    float bar = 0.06f;  // radius
    int sides = 6;      // of a bar's section
    int bar_material = 0;
    int sheet_material = -1;  // lattice or glass; -1: none
    float sheet_thickness = 0.0f;
};
void add_tracery(MeshBuilder& builder, const Opening& opening, const Loop& loop, Head head, float spring,
                 const Tracery& tracery);

}  // namespace daylit::content
