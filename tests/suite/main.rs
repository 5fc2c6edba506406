//! One program of claims about the whole.
//!
//! - `layers`: modules name only what the code map allows.
//! - `cli`: every command, what it prints and how it exits.
//! - `bad_input`, `bad_files`: each slip gets its message and its exit code, and costs no file.
//! - `fit`: readings with errors give the fabric that they are of, and bad sheets their messages.
//! - `scenes`: every scene is certified and looks as it did, in figures and in a picture.
//! - `figures`: what the paper says of its figures is so, and the README gives the numbers.
//! - `maps`: heat maps of cloths whose values are known beforehand.
//! - `follow`: drapes go on while bodies and holds move, and friction remembers.
//! - `dynamics`: cloth with inertia falls, swings, slips and comes to rest as mechanics says.
//! - `holds`: hands bear the weight of what they hold, and a rolled-up cloth is as long as it was.
//! - `fuzz`: no bytes make the readers panic.
//! - `starts`: no scene that they allow makes the solver panic.
//! - `verification`, `friction`: drapes that mathematics knows, and where friction gives way.
//! - `lab`: each instrument reads what closed forms, rod chains and the elastica say, or refuses.
//! - `motions`: captures and keyframes move the bones as they should, and bad ones get their messages.
//! - `honesty`: what the certificate says is left to go is what is left.
//! - `determinism`: the same bits on any number of threads.
//! - `laws`, `laws_contact`, `laws_paper`, `laws_twist`: every law is the slope of its own energy,
//!   and stays what it is wherever the cloth is and whichever way it is turned.
//! - `skeleton`: one bone turns all beyond it, and no other.
//! - `reach`: hands and feet go to where they can, within limits, or say by how far they do not.
//! - `postures`: each slip in a posture file gets its message; those that ship are within limits.
//! - `persons`: the people that ship have bodies as measured, and bad files of people their messages.
//! - `animate`: frame after frame is certified, and a run that was ended goes on to the same bits.
//! - `animation`: an independent reader finds in films what was put into them.
//! - `robot`: whole bodies of the people that ship: as measured, turned, reaching, posed, in motion, and
//!   on the command line.

mod bad_files;
mod bad_input;
mod cli;
mod determinism;
mod dynamics;
mod figures;
mod fit;
mod follow;
mod friction;
mod fuzz;
mod holds;
mod honesty;
mod lab;
mod laws;
mod laws_contact;
mod laws_paper;
mod laws_twist;
mod layers;
mod maps;
mod motions;
mod open_bodies;
mod persons;
mod picture;
mod preview;
mod scenes;
mod solved;
mod specimen;
mod starts;
mod trial;
mod verification;

mod postures;
mod reach;
mod skeleton;
mod woman;

mod animate;
mod animation;
mod arms;
mod rims;
mod robot;
