// Depth of fragments of preclassified triangles, in a frame with a list of crossings.
//
// A face in or close to a clip-surface has the depth of the surface, except for rounding. So depth alone cannot order its fragments and
// the crossing: if necessary, a fragment is moved in front of the crossing or behind it. All other decisions use the moved depth, so all
// decisions of a pixel still compare the same numbers.

#define_import_path cutaway::preclassified_depth

#import cutaway::crossing_words::{normal_of, surface_of_word}
#import cutaway::crossings::{head_of, surface_at, word_at, z_at}
#import cutaway::frame::{buffer_from_depth, centre_of, depth_from_buffer, frame, ray_through}
#import cutaway::preclassified::{beside, of_doubled, preclassified, preclassified_at}

// Greatest distance of a coplanar cutter crossing from a fragment, as a share of its depth-buffer value,
const NEAR_FACE: f32 = 0.000244140625;
// or the depth change of the face over this part of a pixel, because fixed functions move the vertices of both by up to half of 1/16 px
// along each axis,
const NEAR_FACE_PX: f32 = 0.125;
// as long as that does not exceed this share.
const STEEPEST_FACE: f32 = 0.015625;
// Least cosine between the normals of two faces in one plane: those of a list have 13 bits along each axis.
const SAME_PLANE: f32 = 0.9999;

// Greatest distance between a fragment of a plane and another fragment or crossing in it.
fn reach_of_face(z: f32, at: vec2<u32>, normal: vec3<f32>) -> f32 {
    let depth = depth_from_buffer(z);
    var change = 0.0;
    for (var axis = 1u; axis < 3u; axis++) {
        change += abs(dot(normal, frame.ray_origin[axis].xyz + depth * frame.ray_direction[axis].xyz));
    }
    let along = abs(dot(normal, ray_through(centre_of(at)).direction));
    let moved = buffer_from_depth(depth + NEAR_FACE_PX * change / max(along, 1e-6));
    return NEAR_FACE * z + min(z - moved, STEEPEST_FACE * z);
}

// Depth of a fragment coplanar with cutter faces: behind the crossing if the ray enters the solid through the fragment's face, in front if
// it leaves. The crossing is the nearest one with such a cutter in the same plane: a cutter's face ends where the next begins.
fn in_cutters(z: f32, at: vec2<u32>, group: u32, front: bool) -> f32 {
    let cutters = preclassified.groups[group].cutters;
    let normal = preclassified.groups[group].normal.xyz;
    let head = head_of(at);
    var crossing = 0.0;
    var nearest = reach_of_face(z, at, normal);
    for (var i = 0u; i < head.count; i++) {
        let word = word_at(head, i, at);
        let is_of_it = ((cutters >> surface_of_word(word)) & 1u) != 0u;
        if is_of_it && abs(dot(normal_of(word), normal)) > SAME_PLANE {
            let distance = abs(z_at(head, i, at) - z);
            if distance <= nearest {
                nearest = distance;
                crossing = z_at(head, i, at);
            }
        }
    }
    return select(z, beside(z, crossing, !front), crossing > 0.0);
}

// Final depth-buffer value of a group's fragment that was rasterised at `found`.
fn preclassified_z(found: f32, at: vec2<u32>, group: u32, front: bool) -> f32 {
    let z = of_doubled(found, at, group, front);
    let surfaces = preclassified.groups[group].surfaces;
    let removed = preclassified.groups[group].removed;
    let flush = preclassified.groups[group].flush;
    let head = head_of(at);
    var sides = head.sides;
    var moved = z;
    for (var i = 0u; i < head.count; i++) {
        let surface = 1u << surface_at(head, i, at);
        if (surfaces & surface) != 0u {
            let crossing = z_at(head, i, at);
            let is_before = (sides & surface) == (removed & surface);
            moved = preclassified_at(moved, crossing, is_before, (flush & surface) != 0u);
        }
        sides ^= surface;
    }
    if preclassified.groups[group].cutters != 0u {
        return in_cutters(moved, at, group, front);
    }
    return moved;
}
