// Like `solid`, for groups of triangles whose side of the only plane is known, or that coincide with others.

#import cutaway::cuts::parts
#import cutaway::lone_plane::{is_kept, lone_plane_at}
#import cutaway::mesh::Vertex
#import cutaway::preclassified::{of_doubled, preclassified, preclassified_at}
#import cutaway::surface::{Corner, SurfaceAt, corner_of, surface_words}

@vertex
fn vertex(v: Vertex) -> Corner {
    return corner_of(v);
}

@fragment
fn fragment(corner: Corner, @builtin(front_facing) front: bool) -> SurfaceAt {
    let group = preclassified.groups[corner.instance];
    let plane = lone_plane_at(corner.position.xy);
    var z = of_doubled(corner.position.z, vec2<u32>(corner.position.xy), corner.instance, front);
    var is_removed = !is_kept(plane, z);
    if group.surfaces != 0u {
        is_removed = group.removed != 0u;
        if plane.z > 0.0 {
            z = preclassified_at(z, plane.z, is_removed == plane.begins_removed, group.flush != 0u);
        }
    }
    if is_removed {
        discard;
    }
    return SurfaceAt(surface_words(corner, 0u, parts[group.place].part, front), z);
}
