//! `soen animate SCENE --out DIR`: a drape for each frame of a motion, each gone on from the last.
//!
//! Every finished frame is kept in the folder, so that a run that was ended goes on from its last
//! good frame and comes to the same bits.

use crate::{
    args::AnimateWish,
    drape::{set_threads, stopped_by_ctrl_c, try_folder},
    failure::{DONE, Failure, uncertified},
    film::Film,
    progress::Teller,
    say,
};
use soen::{
    contact::Footing,
    lattice::Lattice,
    output::{self, Shot},
    play::{self, ENTRANCE, Frames, Unplayable},
    scene::{self, Scene},
    solver::{self, Settled},
};
use std::{
    fs,
    path::PathBuf,
    process::ExitCode,
    sync::atomic::{AtomicBool, Ordering},
    time::Instant,
};

pub(crate) fn animate(wish: &AnimateWish) -> Result<ExitCode, Failure> {
    let scene = scene::read(&wish.scene)?;
    let frames = frames(&scene)?;
    let wanted = wanted(wish, &frames)?;
    try_folder(&wish.out)?;
    set_threads(wish.run.threads)?;
    let stop = stopped_by_ctrl_c()?;
    let lattice = solver::prepare(&scene.problem).map_err(|error| scene.refusal(error))?;
    let work = Work {
        wish,
        digest: digest(&scene, &frames),
        scene: &scene,
        lattice: &lattice,
        frames,
        stop: &stop,
    };
    let shots = work.shoot(wanted.1)?;
    let film = Film::new(&scene, &lattice, &frames, &shots, wanted);
    film.write(wish)?;
    say(&if wish.run.json {
        film.report()
    } else {
        film.table(&wish.out)
    })?;
    Ok(if film.is_whole() { DONE } else { uncertified() })
}

/// The moments that the scene wants.
fn frames(scene: &Scene) -> Result<Frames, Failure> {
    if !scene.cast.moves() {
        return Err(Failure::Input(
            "nobody moves in this scene: give a [[body]] robot = { person = \"woman-158\", motion = \
             \"walk\" }, or use soen drape"
                .into(),
        ));
    }
    scene.frames.ok_or_else(|| {
        Failure::Input("the scene has no [animation]: give frames = 24, frames_per_s = 24.0".into())
    })
}

/// The first frame that is shown, and the one after the last.
fn wanted(wish: &AnimateWish, frames: &Frames) -> Result<(usize, usize), Failure> {
    let (from, to) = wish.frames.unwrap_or((0, frames.count));
    if from < to && to <= frames.count {
        Ok((from, to))
    } else {
        Err(Failure::Input(format!(
            "--frames is {from}..{to}; allowed: A..B with A below B, up to 0..{}",
            frames.count
        )))
    }
}

/// What all frames stand on: another scene, cloth, person or motion has another digest.
fn digest(scene: &Scene, frames: &Frames) -> u64 {
    let (problem, cast) = (&scene.problem, &scene.cast);
    let whole = format!(
        "{} {problem:?} {cast:?} {} {} {:?}",
        env!("CARGO_PKG_VERSION"),
        scene.settings.tolerance,
        frames.rate,
        frames.pace,
    );
    output::digest(whole.as_bytes())
}

/// A run through the frames.
struct Work<'a> {
    wish: &'a AnimateWish,
    scene: &'a Scene,
    lattice: &'a Lattice,
    frames: Frames,
    digest: u64,
    stop: &'a AtomicBool,
}

impl Work<'_> {
    /// Makes the frames before one, or finds them; fewer where it was stopped.
    fn shoot(&self, end: usize) -> Result<Vec<Shot>, Failure> {
        let mut shots = Vec::new();
        let Some(mut last) = self.dressed()? else {
            return Ok(shots);
        };
        let (mut before, mut goes_on) = (-ENTRANCE, true);
        for frame in 0..end {
            let time = self.frames.time(frame);
            // What followed a frame that is made anew followed another.
            let kept = self.kept(&self.path(frame)).filter(|_| goes_on);
            goes_on = kept.is_some();
            let shot = match kept {
                Some(shot) => shot,
                None => match self.make(frame, [before, time], &last)? {
                    Some(shot) => shot,
                    None => break,
                },
            };
            shots.push(shot.clone());
            (last, before) = (shot, time);
        }
        Ok(shots)
    }

    /// The cloth as it is laid on; `None` where it was stopped.
    fn dressed(&self) -> Result<Option<Shot>, Failure> {
        let path = self.wish.out.join("dressed.state");
        if let Some(shot) = self.kept(&path) {
            return Ok(Some(shot));
        }
        let settled = self.watched("laid on", |watch| {
            play::dress(
                &self.scene.problem,
                &self.scene.cast,
                &self.scene.settings,
                watch,
            )
        })?;
        self.keep(&path, &settled)
    }

    /// Makes one frame; `None` where it was stopped.
    fn make(&self, frame: usize, times: [f64; 2], last: &Shot) -> Result<Option<Shot>, Failure> {
        let (problem, cast) = (&self.scene.problem, &self.scene.cast);
        let lost = || Failure::System("a kept frame does not fit its scene".into());
        let bodies = cast
            .bodies(times[0])
            .map_err(|error| refusal(self.scene, error.into()))?;
        let footing =
            Footing::from_numbers(&last.footing, bodies, self.lattice).ok_or_else(lost)?;
        let (positions, velocities) = (last.positions.as_slice(), last.velocities.as_slice());
        let settings = &self.scene.settings;
        let name = format!("frame {} of {}", frame + 1, self.frames.count);
        let settled = self.watched(&name, |watch| match &self.frames.pace {
            // The first is at rest, and is set going.
            Some(pace) if frame == 0 => {
                let drape =
                    play::next(problem, cast, times, (positions, &footing), settings, watch)?;
                play::set_going(problem, cast, times[1], (&self.frames, pace), drape)
            }
            Some(pace) => {
                let before = (positions, &footing, velocities);
                play::sway(problem, cast, (times, pace), before, settings, watch)
            }
            None => play::next(problem, cast, times, (positions, &footing), settings, watch),
        })?;
        self.keep(&self.path(frame), &settled)
    }

    /// Runs one drape under the clock and Ctrl-C.
    fn watched(
        &self,
        name: &str,
        run: impl FnOnce(&mut dyn FnMut(&solver::Progress) -> bool) -> Result<Settled, Unplayable>,
    ) -> Result<Settled, Failure> {
        let limit = self.wish.run.max_seconds.unwrap_or(self.scene.max_seconds);
        let begin = Instant::now();
        let mut teller = Teller::of(name);
        let settled = run(&mut |progress| {
            teller.tell(progress);
            !self.stop.load(Ordering::Relaxed) && begin.elapsed().as_secs_f64() < limit
        });
        teller.end();
        settled.map_err(|error| refusal(self.scene, error))
    }

    /// Keeps a drape, but not one that Ctrl-C has stopped.
    fn keep(&self, path: &std::path::Path, settled: &Settled) -> Result<Option<Shot>, Failure> {
        if self.stop.load(Ordering::Relaxed) && !settled.converged {
            return Ok(None);
        }
        let shot = Shot::of(settled);
        output::write(path, &shot.to_bytes(self.digest))?;
        Ok(Some(shot))
    }

    /// A frame of this scene that was made before and is at rest.
    fn kept(&self, path: &std::path::Path) -> Option<Shot> {
        let shot = Shot::from_bytes(&fs::read(path).ok()?, self.digest)?;
        let fits = shot.positions.len() == self.lattice.coordinates.len();
        (shot.converged && fits).then_some(shot)
    }

    fn path(&self, frame: usize) -> PathBuf {
        self.wish.out.join(format!("frame-{frame:04}.state"))
    }
}

fn refusal(scene: &Scene, error: Unplayable) -> Failure {
    match error {
        Unplayable::Unsolvable(error) => scene.refusal(error).into(),
        error => Failure::Input(error.to_string()),
    }
}
