//! Small solids, maps and cameras, and what every evaluated frame must satisfy.

use std::f64::consts::PI;
use std::sync::Arc;

use cutaway::layers::Kind;
use cutaway::scene::{
    Camera, ClipSurface, Cut, Mesh, OffsetMap, Part, Prepared, Projection, Scene, Style, Viewpoint,
    Wrap,
};
use cutaway_lab::exact::{Exact, evaluate};
use glam::{DVec3, dvec3};

/// An axis-aligned box.
pub(crate) fn cuboid(min: DVec3, max: DVec3) -> Mesh {
    let corner = |i: usize| {
        dvec3(
            if i & 1 == 0 { min.x } else { max.x },
            if i & 2 == 0 { min.y } else { max.y },
            if i & 4 == 0 { min.z } else { max.z },
        )
    };
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    Mesh {
        positions: (0..8).map(corner).collect(),
        triangles: quads
            .iter()
            .flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]])
            .collect(),
        corner_normals: None,
        vertex_paint: None,
    }
}

/// The cube of edge 1 around the origin.
pub(crate) fn unit_cube() -> Mesh {
    cuboid(DVec3::splat(-0.5), DVec3::splat(0.5))
}

/// A ball around the origin with its poles on z.
pub(crate) fn ball(radius: f64, rings: u32, segments: u32) -> Mesh {
    let mut positions = vec![DVec3::Z * radius];
    for ring in 1..rings {
        let polar = PI * f64::from(ring) / f64::from(rings);
        for segment in 0..segments {
            let turn = 2.0 * PI * f64::from(segment) / f64::from(segments);
            positions.push(
                radius
                    * dvec3(
                        polar.sin() * turn.cos(),
                        polar.sin() * turn.sin(),
                        polar.cos(),
                    ),
            );
        }
    }
    positions.push(DVec3::NEG_Z * radius);
    let last = positions.len() as u32 - 1;
    let at = |ring: u32, segment: u32| match ring {
        0 => 0,
        r if r == rings => last,
        r => 1 + (r - 1) * segments + segment % segments,
    };
    let mut triangles = Vec::new();
    for ring in 0..rings {
        for s in 0..segments {
            let [a, b, c, d] = [
                at(ring, s),
                at(ring + 1, s),
                at(ring + 1, s + 1),
                at(ring, s + 1),
            ];
            if ring + 1 < rings {
                triangles.push([a, b, c]);
            }
            if ring > 0 {
                triangles.push([a, c, d]);
            }
        }
    }
    Mesh {
        positions,
        triangles,
        corner_normals: None,
        vertex_paint: None,
    }
}

/// The mesh inside out.
pub(crate) fn inside_out(mut mesh: Mesh) -> Mesh {
    for t in &mut mesh.triangles {
        t.swap(1, 2);
    }
    mesh
}

/// Two meshes as one.
pub(crate) fn joined(mut a: Mesh, b: Mesh) -> Mesh {
    let first = a.positions.len() as u32;
    a.positions.extend(b.positions);
    a.triangles
        .extend(b.triangles.into_iter().map(|t| t.map(|i| i + first)));
    a
}

/// The mesh with its positions mapped.
pub(crate) fn mapped(mut mesh: Mesh, map: impl Fn(DVec3) -> DVec3) -> Mesh {
    for p in &mut mesh.positions {
        *p = map(*p);
    }
    mesh
}

/// A scene of named parts, each with its mesh, and cuts of all of them, one per list of surfaces.
pub(crate) fn scene(meshes: Vec<Mesh>, cuts: Vec<Vec<ClipSurface>>, camera: Camera) -> Scene {
    Scene {
        name: "test".into(),
        parts: meshes
            .into_iter()
            .enumerate()
            .map(|(i, m)| Part::new(format!("p{i}"), m))
            .collect(),
        cuts: cuts
            .into_iter()
            .enumerate()
            .map(|(i, s)| Cut::new(format!("c{i}"), s))
            .collect(),
        camera,
        style: Style::default(),
        stage: None,
        outline: None,
        interference: None,
    }
}

/// Parallel rays from `position` toward `focus`, `height` world units high.
pub(crate) fn parallel(position: DVec3, focus: DVec3, height: f64) -> Camera {
    Camera {
        viewpoint: Viewpoint::Explicit {
            position,
            focal_point: focus,
            view_up: None,
        },
        projection: Projection::Orthographic {
            height: Some(height),
        },
        ..Camera::default()
    }
}

/// A perspective camera.
pub(crate) fn eye(position: DVec3, focus: DVec3, fov_y_deg: f64) -> Camera {
    Camera {
        viewpoint: Viewpoint::Explicit {
            position,
            focal_point: focus,
            view_up: None,
        },
        projection: Projection::Perspective { fov_y_deg },
        ..Camera::default()
    }
}

/// An orbit of the default distance.
pub(crate) fn orbit(azimuth_deg: f64, elevation_deg: f64) -> Camera {
    Camera {
        viewpoint: Viewpoint::Orbit {
            azimuth_deg,
            elevation_deg,
        },
        ..Camera::default()
    }
}

/// A relief over the plane z = `level` that keeps what is below it. One map is `period` long; heights add to z.
pub(crate) fn relief(level: f64, period: f64, height: f64, map: OffsetMap) -> ClipSurface {
    ClipSurface {
        origin: DVec3::Z * level,
        // u x v = -z: the kept side is below, and the surface lies at z = level + f * height.
        u: DVec3::Y * period,
        v: DVec3::X * period,
        scale: dvec3(1.0, 1.0, height),
        relief: Some(Arc::new(map)),
        wrap: Wrap::Repeat,
    }
}

/// Reproducible numbers in 0..1.
pub(crate) fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Sums of octaves of noise, from rough to fine.
pub(crate) fn fractal(size: u32, seed: u64) -> OffsetMap {
    let mut texels = vec![0.0f32; (size * size) as usize];
    let mut cells = 4;
    let mut weight = 0.5f32;
    while cells <= size {
        let mut random = noise(seed + u64::from(cells));
        let grid = OffsetMap::new(
            [cells; 2],
            (0..cells * cells).map(|_| random() as f32).collect(),
        )
        .expect("noise is finite");
        for (i, texel) in texels.iter_mut().enumerate() {
            let at = glam::dvec2((i as u32 % size) as f64, (i as u32 / size) as f64) + 0.5;
            let (height, _) = grid.sample(Wrap::Repeat, at / f64::from(size));
            *texel += weight * (height as f32 - 0.5);
        }
        (cells, weight) = (cells * 2, weight * 0.5);
    }
    OffsetMap::new([size; 2], texels).expect("noise is finite")
}

/// Evaluates a scene with its own camera.
pub(crate) fn frame(scene: &Scene, size_px: [u32; 2]) -> Exact {
    let prepared = Prepared::new(scene);
    evaluate(&prepared, &prepared.view(size_px))
}

/// Evaluates a scene of closed parts, of which nothing may be odd, see-through or without depth.
pub(crate) fn sound(scene: &Scene, size_px: [u32; 2]) -> Exact {
    let exact = frame(scene, size_px);
    assert_eq!(
        odd(&exact),
        0,
        "closed parts are crossed an even number of times"
    );
    for layer in &exact.layers.pixels {
        let shown = layer.kind != Kind::Background;
        assert_eq!(
            layer.depth.is_finite(),
            shown,
            "depth {} of {:?}",
            layer.depth,
            layer.kind
        );
        assert!(!layer.back_face, "a pixel shows the inside of the shell");
        if shown {
            let length = layer.normal.length();
            assert!((length - 1.0).abs() < 1e-5, "normal of length {length}");
        }
    }
    exact
}

/// Pixels with an odd number of crossings.
pub(crate) fn odd(exact: &Exact) -> usize {
    exact.odd_parity.iter().filter(|o| **o).count()
}

/// Pixels whose kind, part or clip-surface differs, leaving out what is undecided in either frame.
pub(crate) fn differing(a: &Exact, b: &Exact) -> usize {
    (0..a.layers.pixels.len())
        .filter(|i| !a.undecided[*i] && !b.undecided[*i])
        .filter(|i| {
            let label = |e: &Exact| {
                let l = &e.layers.pixels[*i];
                (l.kind, l.part, l.clip_surface)
            };
            label(a) != label(b)
        })
        .count()
}
