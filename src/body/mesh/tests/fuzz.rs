//! Bytes that are no mesh, or hardly one: each reader answers, and soon.

use std::time::{Duration, Instant};

use proptest::{collection::vec, prelude::*, sample::Index};

use super::*;

/// Longest time for a file of a kilobyte or two, in a build for debugging on a busy machine.
const SOON: Duration = Duration::from_secs(2);

fn read_soon(format: Format, bytes: &[u8]) -> Result<(), TestCaseError> {
    let start = Instant::now();
    let result = Mesh::read(bytes, format, Unit::Centimetre, Up::Z);
    prop_assert!(start.elapsed() < SOON, "{format:?}: {:?}", start.elapsed());
    match result {
        Err(error) => prop_assert!(!error.to_string().is_empty()),
        Ok(mesh) => {
            let count = mesh.vertices.len() as u32;
            prop_assert!(
                mesh.triangles
                    .iter()
                    .flatten()
                    .all(|&corner| corner < count)
            );
            prop_assert!(
                mesh.vertices
                    .iter()
                    .flatten()
                    .all(|cm| cm.abs() <= FARTHEST)
            );
            prop_assert!(!mesh.inspection().to_string().is_empty());
        }
    }
    Ok(())
}

fn any_format() -> impl Strategy<Value = Format> {
    prop::sample::select(vec![Format::Obj, Format::Stl, Format::Ply, Format::Gltf])
}

/// One change to a file.
#[derive(Clone, Debug)]
enum Damage {
    Cut(Index),
    Flip(Index, u8),
    Insert(Index, Vec<u8>),
    Repeat(Index, Index),
    Digit(Index, u8),
}

fn damage() -> impl Strategy<Value = Damage> {
    prop_oneof![
        any::<Index>().prop_map(Damage::Cut),
        (any::<Index>(), 0..8_u8).prop_map(|(at, bit)| Damage::Flip(at, bit)),
        (any::<Index>(), vec(any::<u8>(), 1..9)).prop_map(|(at, new)| Damage::Insert(at, new)),
        (any::<Index>(), any::<Index>()).prop_map(|(from, to)| Damage::Repeat(from, to)),
        (any::<Index>(), b'0'..=b'9').prop_map(|(at, digit)| Damage::Digit(at, digit)),
    ]
}

fn apply(bytes: &mut Vec<u8>, damage: &Damage) {
    if bytes.is_empty() {
        return;
    }
    match damage {
        Damage::Cut(at) => bytes.truncate(at.index(bytes.len())),
        Damage::Flip(at, bit) => {
            let at = at.index(bytes.len());
            bytes[at] ^= 1 << bit;
        }
        Damage::Insert(at, new) => {
            let at = at.index(bytes.len());
            bytes.splice(at..at, new.iter().copied());
        }
        Damage::Repeat(from, to) => {
            let (from, to) = (from.index(bytes.len()), to.index(bytes.len()));
            let again = bytes[from.min(to)..from.max(to)].to_vec();
            bytes.extend(again);
        }
        Damage::Digit(at, digit) => {
            // Numbers are where the trouble is: the next one from here on gets another digit.
            let at = at.index(bytes.len());
            if let Some(number) = bytes[at..].iter().position(u8::is_ascii_digit) {
                bytes.insert(at + number, *digit);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]

    #[test]
    fn arbitrary_bytes_are_answered(format in any_format(), bytes in vec(any::<u8>(), 0..400)) {
        read_soon(format, &bytes)?;
    }

    #[test]
    fn arbitrary_bytes_after_a_good_head_are_answered(
        (format, head) in prop::sample::select(heads()),
        bytes in vec(any::<u8>(), 0..400),
    ) {
        read_soon(format, &[head, bytes].concat())?;
    }

    #[test]
    fn damaged_files_are_answered(
        (format, file) in prop::sample::select(files::all()),
        damages in vec(damage(), 1..6),
    ) {
        let mut bytes = file;
        damages.iter().for_each(|damage| apply(&mut bytes, damage));
        read_soon(format, &bytes)?;
    }

    #[test]
    fn arbitrary_faces_over_few_places_are_answered(
        places in vec([-2..3_i8, -2..3, -2..3], 3..12),
        faces in vec([0..12_u32, 0..12, 0..12], 1..40),
    ) {
        let vertices: Vec<_> = places.iter().map(|p| Vec3::from(p.map(f64::from))).collect();
        let count = vertices.len() as u32;
        let faces: Vec<_> = faces.into_iter().map(|face| face.map(|corner| corner % count)).collect();
        let Ok(mesh) = Mesh::new(vertices, faces) else { return Ok(()) };
        // What is clean stays as it is, but for the report of what was done.
        let again = Mesh::new(mesh.vertices.clone(), mesh.triangles.clone()).unwrap();
        prop_assert_eq!(&again.vertices, &mesh.vertices);
        prop_assert_eq!(again.inspection().closed, mesh.inspection().closed);
        prop_assert_eq!((again.inspection().degenerate, again.inspection().duplicate), (0, 0));
    }
}

/// The beginnings of files, up to where the data starts.
fn heads() -> Vec<(Format, Vec<u8>)> {
    let head_of_ply = |greatest_first| {
        let mut bytes = files::ply(greatest_first);
        let end = bytes
            .windows(11)
            .position(|w| w == b"end_header\n")
            .unwrap();
        bytes.truncate(end + 11);
        (Format::Ply, bytes)
    };
    vec![
        head_of_ply(None),
        head_of_ply(Some(false)),
        head_of_ply(Some(true)),
        (Format::Stl, files::stl_binary()[..84].to_vec()),
        (
            Format::Stl,
            b"solid a\nfacet normal 0 0 1\nouter loop\n".to_vec(),
        ),
        (Format::Gltf, files::glb()[..20].to_vec()),
    ]
}
