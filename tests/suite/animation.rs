//! Films are read by programs that know nothing of ours, and have in them what was put there.

use crate::picture::pixels;
use gltf::{
    Gltf,
    animation::{Interpolation, Property, util::ReadOutputs},
};
use soen::{
    lattice::Lattice,
    math::{Vec2, Vec3},
    output::{BodyMesh, Film, Image, animated_glb, animated_png, contact_sheet},
    robot::Ball,
};
use std::io::Cursor;

/// A square of cells [1 cm], `side` nodes along each edge.
fn lattice(side: u32) -> Lattice {
    let node = |i: u32, j: u32| j * side + i;
    let places = (0..side * side).map(|k| [k % side, k / side]);
    let cells = places
        .clone()
        .filter(|[i, j]| i + 1 < side && j + 1 < side)
        .map(|[i, j]| {
            [
                node(i, j),
                node(i + 1, j),
                node(i + 1, j + 1),
                node(i, j + 1),
            ]
        });
    Lattice {
        pitch: 1.0,
        coordinates: places
            .clone()
            .map(|[i, j]| Vec2::new(f64::from(i), f64::from(j)))
            .collect(),
        cells: cells.collect(),
        ..Lattice::default()
    }
}

/// A flag that waves, [cm].
fn waving(lattice: &Lattice, second: f64) -> Vec<Vec3> {
    let wave = |c: &Vec2| {
        Vec3::new(
            c.x,
            30.0 * second,
            90.0 + 2.0 * (0.4 * c.x + second).sin() + c.y,
        )
    };
    lattice.coordinates.iter().map(wave).collect()
}

/// Three balls: one walks, one breathes, one rests.
fn balls(second: f64) -> Vec<Ball> {
    let ball = |x, y, z, radius| Ball {
        centre: Vec3::new(x, y, z),
        radius,
    };
    vec![
        ball(10.0, -30.0 * second, 90.0 + second.sin(), 8.0),
        ball(-5.0, 3.0, 120.0, 12.0 + second.cos()),
        ball(0.0, 1.0, 2.0, 3.0),
    ]
}

fn tetrahedron() -> BodyMesh {
    BodyMesh {
        name: "rock".into(),
        vertices: vec![Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::z()],
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
    }
}

/// Metres, y up, from cm, z up.
fn y_up(p: &Vec3) -> [f32; 3] {
    [p.x / 100.0, p.z / 100.0, -p.y / 100.0].map(|x| x as f32)
}

fn near(a: [f32; 3], b: [f32; 3]) -> bool {
    // Three roundings of numbers up to 2 m: 2⁻²³ each.
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 4e-7)
}

const SECONDS: [f64; 5] = [2.0, 2.04, 2.1, 2.125, 2.5];

/// What moves a node: its times and values.
fn channel(file: &Gltf, node: usize, property: Property) -> Option<(Vec<f32>, Vec<f32>)> {
    let mut channels = file.animations().next()?.channels().filter(|channel| {
        channel.target().node().index() == node && channel.target().property() == property
    });
    let channel = channels.next()?;
    assert!(channels.next().is_none());
    assert_eq!(channel.sampler().interpolation(), Interpolation::Linear);
    let reader = channel.reader(|_| file.blob.as_deref());
    let times: Vec<f32> = reader.read_inputs().unwrap().collect();
    let bound = |value: Option<gltf::json::Value>| {
        value.unwrap().as_array().unwrap()[0].as_f64().unwrap() as f32
    };
    let input = channel.sampler().input();
    assert_eq!(
        (bound(input.min()), bound(input.max())),
        (times[0], times[times.len() - 1])
    );
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
    let values = match reader.read_outputs().unwrap() {
        ReadOutputs::Translations(rows) => rows.flatten().collect(),
        ReadOutputs::Scales(rows) => rows.flatten().collect(),
        ReadOutputs::MorphTargetWeights(weights) => weights.into_f32().collect(),
        ReadOutputs::Rotations(_) => panic!("nothing turns"),
    };
    Some((times, values))
}

/// Where the cloth is while its morph targets have weights.
fn morphed(file: &Gltf, weights: &[f32]) -> Vec<[f32; 3]> {
    let mesh = file
        .meshes()
        .find(|mesh| mesh.name() == Some("cloth"))
        .unwrap();
    let primitive = mesh.primitives().next().unwrap();
    let reader = primitive.reader(|_| file.blob.as_deref());
    let mut positions: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
    let normals = reader.read_normals().unwrap().count();
    assert_eq!(
        (normals, reader.read_morph_targets().count()),
        (positions.len(), weights.len())
    );
    for (weight, (moved, turned, _)) in weights.iter().zip(reader.read_morph_targets()) {
        assert_eq!(turned.unwrap().count(), positions.len());
        let moved: Vec<[f32; 3]> = moved.unwrap().collect();
        assert_eq!(moved.len(), positions.len());
        for (p, d) in positions.iter_mut().zip(moved) {
            *p = std::array::from_fn(|k| p[k] + weight * d[k]);
        }
    }
    // What the file says of the displacements' bounds is so.
    for target in primitive.morph_targets() {
        let accessor = target.positions().unwrap();
        assert!(accessor.min().is_some() && accessor.max().is_some());
    }
    positions
}

#[test]
fn the_cloth_is_where_it_was_at_each_frame_and_halfway_between() {
    let lattice = lattice(9);
    let frames = SECONDS.map(|second| waving(&lattice, second));
    let film = Film {
        title: "A flag",
        lattice: &lattice,
        frames: &frames,
        bodies: &[tetrahedron()],
        balls: &SECONDS.map(balls),
        seconds: &SECONDS,
    };
    let file = Gltf::from_slice(&animated_glb(&film)).unwrap();
    assert_eq!(file.animations().next().unwrap().name(), Some("A flag"));
    let node = file
        .nodes()
        .find(|node| node.name() == Some("cloth"))
        .unwrap();
    let (times, weights) = channel(&file, node.index(), Property::MorphTargetWeights).unwrap();
    assert_eq!(times, SECONDS.map(|second| (second - 2.0) as f32));
    let rows: Vec<&[f32]> = weights.chunks_exact(4).collect();
    assert_eq!(rows.len(), 5);
    for (row, frame) in rows.iter().zip(&frames) {
        let shown = morphed(&file, row);
        assert!(shown.iter().zip(frame).all(|(&a, b)| near(a, y_up(b))));
    }
    for (pair, frames) in rows.windows(2).zip(frames.windows(2)) {
        let half: Vec<f32> = pair[0]
            .iter()
            .zip(pair[1])
            .map(|(a, b)| 0.5 * (a + b))
            .collect();
        let middle = frames[0].iter().zip(&frames[1]).map(|(a, b)| 0.5 * (a + b));
        let shown = morphed(&file, &half);
        assert!(shown.iter().zip(middle).all(|(&a, b)| near(a, y_up(&b))));
    }
}

#[test]
fn balls_are_nodes_of_one_mesh_and_only_what_moves_has_channels() {
    let lattice = lattice(3);
    let film = Film {
        title: "",
        lattice: &lattice,
        frames: &[],
        bodies: &[tetrahedron()],
        balls: &SECONDS.map(balls),
        seconds: &SECONDS,
    };
    let file = Gltf::from_slice(&animated_glb(&film)).unwrap();
    let names: Vec<_> = file.meshes().map(|mesh| mesh.name().unwrap()).collect();
    assert_eq!(names, ["rock", "ball"]);
    let nodes: Vec<_> = file
        .nodes()
        .filter(|node| node.mesh().unwrap().index() == 1)
        .collect();
    assert_eq!(nodes.len(), 3);
    for (number, node) in nodes.iter().enumerate() {
        let (place, _, size) = node.transform().decomposed();
        let first = balls(SECONDS[0])[number];
        assert!(near(place, y_up(&first.centre)));
        assert!(near(size, [(first.radius / 100.0) as f32; 3]));
    }
    let ways = [Property::Translation, Property::Scale].map(|property| {
        nodes
            .iter()
            .map(|node| channel(&file, node.index(), property))
            .collect::<Vec<_>>()
    });
    let moving = ways
        .each_ref()
        .map(|way| way.iter().map(Option::is_some).collect::<Vec<_>>());
    assert_eq!(moving, [[true, false, false], [false, true, false]]);
    for (frame, &second) in SECONDS.iter().enumerate() {
        let row = |values: &[f32]| std::array::from_fn(|k| values[3 * frame + k]);
        let now = balls(second);
        assert!(near(
            row(&ways[0][0].as_ref().unwrap().1),
            y_up(&now[0].centre)
        ));
        assert!(near(
            row(&ways[1][1].as_ref().unwrap().1),
            [(now[1].radius / 100.0) as f32; 3]
        ));
    }
}

#[test]
fn one_frame_stands_still_and_nothing_is_still_a_file() {
    let lattice = lattice(4);
    let frames = [waving(&lattice, 0.0)];
    let film = Film {
        title: "still",
        lattice: &lattice,
        frames: &frames,
        bodies: &[],
        balls: &[],
        seconds: &[7.0],
    };
    let file = Gltf::from_slice(&animated_glb(&film)).unwrap();
    assert_eq!((file.animations().count(), file.nodes().count()), (0, 1));
    assert!(
        morphed(&file, &[])
            .iter()
            .zip(&frames[0])
            .all(|(&a, b)| near(a, y_up(b)))
    );
    let nothing = Film {
        frames: &[],
        seconds: &[],
        ..film
    };
    let file = Gltf::from_slice(&animated_glb(&nothing)).unwrap();
    assert_eq!((file.animations().count(), file.nodes().count()), (0, 0));
}

#[test]
fn broken_frames_show_what_was_before_and_times_that_fall_back_are_left_out() {
    let lattice = lattice(4);
    let mut frames = [0.0, 0.1, 0.2, 0.3].map(|second| waving(&lattice, second));
    frames[2][5].x = f64::NAN;
    frames[3].truncate(7);
    let film = Film {
        title: "broken",
        lattice: &lattice,
        frames: &frames,
        bodies: &[],
        balls: &[balls(0.0), vec![]],
        seconds: &[0.0, 0.1, 0.2, 0.2, f64::NAN, 0.3],
    };
    let file = Gltf::from_slice(&animated_glb(&film)).unwrap();
    let (times, weights) = channel(&file, 0, Property::MorphTargetWeights).unwrap();
    assert_eq!(times, [0.0, 0.1, 0.2, 0.3]);
    let third = morphed(&file, &weights[6..9]);
    assert!(near(third[5], y_up(&frames[1][5])) && near(third[6], y_up(&frames[2][6])));
}

#[test]
fn a_large_film_takes_what_its_numbers_take() {
    let lattice = lattice(71);
    let seconds: Vec<f64> = (0..300).map(|k| f64::from(k) / 30.0).collect();
    let frames: Vec<Vec<Vec3>> = seconds.iter().map(|&s| waving(&lattice, s)).collect();
    let balls: Vec<Vec<Ball>> = seconds
        .iter()
        .map(|&second| (0..100).flat_map(|_| balls(second)).collect())
        .collect();
    let film = Film {
        title: "long",
        lattice: &lattice,
        frames: &frames,
        bodies: &[],
        balls: &balls,
        seconds: &seconds,
    };
    let bytes = animated_glb(&film).len();
    // 24 bytes per node and frame, a weight per pair of frames, 12 bytes per moved ball and frame.
    let numbers = 300 * 71 * 71 * 24 + 4 * 300 * 299 + 200 * 300 * 12;
    assert!(
        bytes > numbers && (bytes as f64) < 1.03 * numbers as f64,
        "{bytes}"
    );
}

/// A film of a square that goes over a ground of so many colours.
fn pictures(colours: u32) -> Vec<Image> {
    let ground = |k: u32| [(k % colours % 256) as u8, (k % colours / 256) as u8, 9];
    let picture = |frame: u32| Image {
        width: 40,
        height: 30,
        pixels: (0..1200)
            .map(|k| {
                let (x, y) = (k % 40, k / 40);
                let inside = (4 * frame..4 * frame + 6).contains(&x) && (9..12).contains(&y);
                if inside { [255, 0, 255] } else { ground(k) }
            })
            .collect(),
    };
    // The third does not differ from the second.
    [0, 1, 1, 5].map(picture).to_vec()
}

/// An animated picture as a viewer shows it.
struct Played {
    /// The whole picture at each frame.
    shown: Vec<Vec<[u8; 3]>>,
    /// How long each is shown [s], as a fraction.
    delays: Vec<(u16, u16)>,
    /// How often, 0 for ever.
    plays: u32,
}

/// Lays each part over what was there.
fn played(bytes: &[u8]) -> Played {
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().unwrap();
    let control = *reader.info().animation_control().unwrap();
    let width = reader.info().width as usize;
    let mut canvas = vec![[0; 3]; width * reader.info().height as usize];
    let (mut shown, mut delays) = (Vec::new(), Vec::new());
    let mut buffer = vec![0; reader.output_buffer_size().unwrap()];
    for _ in 0..control.num_frames {
        reader.next_frame(&mut buffer).unwrap();
        let part = *reader.info().frame_control().unwrap();
        assert_eq!(part.blend_op, png::BlendOp::Source);
        assert_eq!(part.dispose_op, png::DisposeOp::None);
        delays.push((part.delay_num, part.delay_den));
        for (k, pixel) in buffer.as_chunks::<3>().0.iter().enumerate() {
            let (x, y) = (k % part.width as usize, k / part.width as usize);
            if y < part.height as usize {
                canvas[(y + part.y_offset as usize) * width + x + part.x_offset as usize] = *pixel;
            }
        }
        shown.push(canvas.clone());
    }
    Played {
        shown,
        delays,
        plays: control.num_plays,
    }
}

#[test]
fn an_animated_picture_plays_every_pixel_for_ever() {
    for colours in [7, 200, 1000] {
        let pictures = pictures(colours);
        let bytes = animated_png(&pictures, 12);
        let film = played(&bytes);
        assert_eq!((film.delays, film.plays), (vec![(1, 12); 4], 0));
        for (shown, picture) in film.shown.iter().zip(&pictures) {
            assert!(shown == &picture.pixels, "{colours} colours");
        }
        // The film is smaller than its pictures one by one.
        let whole: usize = pictures.iter().map(|picture| picture.to_png().len()).sum();
        assert!(bytes.len() < whole, "{} of {whole} bytes", bytes.len());
    }
}

#[test]
fn pictures_that_do_not_fit_are_left_out_of_a_film() {
    let mut pictures = pictures(7);
    pictures[1].width = 39;
    pictures[2].pixels.pop();
    assert_eq!(played(&animated_png(&pictures, 0)).delays, [(1, 1); 2]);
    assert!(animated_png(&[], 9).is_empty());
    pictures[0].pixels.clear();
    assert_eq!(
        played(&animated_png(&pictures, 9)).shown,
        [pictures[3].pixels.clone()]
    );
}

#[test]
fn a_sheet_has_every_picture_in_its_place() {
    let pictures = pictures(300);
    let ([width, height], channels) = pixels(&contact_sheet(&pictures[..3], 2));
    assert_eq!([width, height], [84, 64]);
    let at = |x: usize, y: usize| &channels[3 * (84 * y + x)..][..3];
    for (picture, [left, top]) in pictures.iter().zip([[0, 0], [44, 0], [0, 34]]) {
        for (k, pixel) in picture.pixels.iter().enumerate() {
            assert_eq!(at(left + k % 40, top + k / 40), pixel);
        }
    }
    for white in [[41, 3], [3, 31], [60, 50]] {
        assert_eq!(at(white[0], white[1]), [255; 3]);
    }
    assert!(contact_sheet(&[], 3).is_empty());
}
