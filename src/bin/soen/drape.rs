//! `soen drape SCENE --out DIR`.

use crate::{
    args::Wish,
    failure::{DONE, Failure, uncertified},
    files::Files,
    progress::Teller,
    say,
};
use soen::{
    output::{self, Run},
    scene::{self, Scene},
    solver::{self, Settings, Settled},
};
use std::{
    fs,
    path::Path,
    process::ExitCode,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::Instant,
};

pub(crate) fn drape(wish: &Wish) -> Result<ExitCode, Failure> {
    let mut scene = scene::read(&wish.scene)?;
    try_folder(&wish.out)?;
    let threads = set_threads(wish.run.threads)?;
    let stop = stopped_by_ctrl_c()?;
    let begin = Instant::now();
    if wish.preview {
        scene.problem = scene.problem.preview();
        scene.title += " (preview)";
    }
    let settled = settle(wish, &scene, begin, &stop)?;
    let run = Run {
        title: &scene.title,
        fabric: &scene.fabric,
        seconds: begin.elapsed().as_secs_f64(),
        threads,
    };
    let report = output::report(&settled, &run);
    Files::new(wish, &scene, &settled).write(&report)?;
    say(&if wish.run.json {
        report
    } else {
        certificate(&settled, &run, &wish.out)
    })?;
    Ok(if settled.converged {
        DONE
    } else {
        uncertified()
    })
}

/// Finds out before the long work whether its result can be kept, and leaves no trace of it: a
/// drape that comes to nothing makes no folder.
pub(crate) fn try_folder(folder: &Path) -> Result<(), Failure> {
    let absent = folder.ancestors().take_while(|above| !above.exists());
    let absent: Vec<&Path> = absent.collect();
    let trial = folder.join(format!(".soen-{}.trial", std::process::id()));
    let kept = output::write(&trial, b"").map_err(Failure::from);
    let cleared = kept.and_then(|()| {
        fs::remove_file(&trial).map_err(|error| {
            Failure::System(format!("cannot write in {}: {error}", folder.display()))
        })
    });
    for made in absent {
        // The deepest first. What is not empty is not ours alone, and stays.
        let _ = fs::remove_dir(made);
    }
    cleared
}

#[cfg(feature = "threads")]
pub(crate) fn set_threads(wished: Option<u16>) -> Result<usize, Failure> {
    // 0 asks rayon for as many as there are cores.
    rayon::ThreadPoolBuilder::new()
        .num_threads(wished.unwrap_or(0).into())
        .build_global()
        .map_err(|error| Failure::System(format!("cannot start threads: {error}")))?;
    Ok(rayon::current_num_threads())
}

#[cfg(not(feature = "threads"))]
pub(crate) fn set_threads(wished: Option<u16>) -> Result<usize, Failure> {
    match wished {
        None | Some(1) => Ok(1),
        Some(_) => Err(Failure::Input(
            "built without threads; allowed: --threads 1".into(),
        )),
    }
}

/// A flag that Ctrl-C raises; a second Ctrl-C ends the program at once.
pub(crate) fn stopped_by_ctrl_c() -> Result<Arc<AtomicBool>, Failure> {
    let stop = Arc::new(AtomicBool::new(false));
    let raised = Arc::clone(&stop);
    let set = ctrlc::set_handler(move || {
        if raised.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
    set.map_err(|error| Failure::System(format!("cannot listen for Ctrl-C: {error}")))?;
    Ok(stop)
}

fn settle(
    wish: &Wish,
    scene: &Scene,
    begin: Instant,
    stop: &AtomicBool,
) -> Result<Settled, Failure> {
    let limit = wish.run.max_seconds.unwrap_or(scene.max_seconds);
    let settings = Settings {
        frames: wish.frames.into(),
        ..scene.settings
    };
    let mut teller = Teller::new();
    let settled = solver::settle(&scene.problem, &settings, &mut |progress| {
        teller.tell(progress);
        !stop.load(Ordering::Relaxed) && begin.elapsed().as_secs_f64() < limit
    });
    teller.end();
    Ok(settled.map_err(|error| scene.refusal(error))?)
}

/// The certificate as a short table.
fn certificate(settled: &Settled, run: &Run<'_>, out: &Path) -> String {
    let (proof, shape) = (&settled.certificate, &settled.shape);
    let verdict = if settled.converged {
        "certified: at rest"
    } else {
        "NOT certified: stopped before it was at rest"
    };
    format!(
        "{}\n{verdict}\n\
         \x20 residual       {:.2e} greatest, {:.2e} mean\n\
         \x20 still to move  {:.4} cm at most\n\
         \x20 contact        {} nodes touch, {} pulled, {} outside their cone, {:.4} cm deepest\n\
         \x20 height         {:.3} to {:.3} cm, mean {:.3} cm\n\
         \x20 strain         {:.2} % warp, {:.2} % weft, shear {:.1}°\n\
         \x20 work           {} nodes, {:.1} s, {} threads\n\
         \x20 written        {}\n",
        run.title,
        proof.residual_max,
        proof.residual_rms,
        proof.remaining_move,
        proof.touching,
        proof.pulled,
        proof.outside_cone,
        proof.deepest,
        shape.lowest,
        shape.highest,
        shape.mean_height,
        100.0 * shape.strain_warp_max,
        100.0 * shape.strain_weft_max,
        shape.shear_max.to_degrees(),
        settled.positions.len(),
        run.seconds,
        run.threads,
        out.display(),
    )
}
