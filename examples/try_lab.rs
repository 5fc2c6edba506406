use soen::{fabric::Yarn, lab};
use std::time::Instant;
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let args: Vec<String> = std::env::args().collect();
    let names: Vec<&str> = args[2].split(',').collect();
    for name in names {
        let f = soen::scene::fabric(name)?;
        for yarn in [Yarn::Warp, Yarn::Weft] {
            let t = Instant::now();
            let r = match args[1].as_str() {
                "cant" => {
                    let c = lab::Cantilever {
                        yarn,
                        overhang: args[3].parse()?,
                        pitch: args[4].parse()?,
                    };
                    c.run(&f, &mut |_| true)?.reading(&c)
                }
                "over" => lab::Cantilever::overhang(&f, yarn, args[3].parse()?, &mut |_| true)?
                    .reading(&f, yarn),
                "hung" => lab::HungStrip {
                    yarn,
                    length: args[3].parse()?,
                    pitch: args[4].parse()?,
                }
                .run(&f, &mut |_| true)?
                .reading(),
                "pull" => {
                    let r = lab::Pull {
                        cut: yarn.into(),
                        ..Default::default()
                    }
                    .run(&f, &mut |_| true)?;
                    println!("{:?}", r.curve);
                    r.reading()
                }
                "shear" => {
                    let s = lab::ShearFrame {
                        along: yarn,
                        load: args[3].parse()?,
                        pitch: args[4].parse()?,
                        ..Default::default()
                    };
                    let r = s.run(&f, &mut |_| true)?;
                    for p in &r.positions {
                        println!(
                            "{:.3} F {:.4} M {:.4} h {:.4}",
                            p.angle.to_degrees(),
                            p.force,
                            (p.force - p.of_load) / p.angle.tan() * p.stretch,
                            p.rest
                                .settled
                                .positions
                                .iter()
                                .map(|p| p.y)
                                .fold(0.0, f64::max)
                        );
                    }
                    r.reading()
                }
                "slope" => {
                    let s = lab::Slope {
                        friction: args[3].parse()?,
                        size: 8.0,
                        pitch: 1.0,
                    };
                    s.run(&f, &mut |_| true)?.reading(&s)
                }
                "capstan" => {
                    let s = lab::Capstan {
                        yarn,
                        friction: args[3].parse()?,
                        pitch: args[4].parse()?,
                        ..Default::default()
                    };
                    s.run(&f, &mut |_| true)?.reading(&s)
                }
                "heart" => lab::HeartLoop {
                    yarn,
                    length: args[3].parse()?,
                    pitch: args[4].parse()?,
                }
                .run(&f, &mut |_| true)?
                .reading(),
                "drape" => lab::Drapemeter {
                    pitch: args[3].parse()?,
                    seeds: args[4].parse()?,
                    ..Default::default()
                }
                .run(&f, &mut |_| true)?
                .reading(),
                _ => panic!(),
            };
            print!(
                "{name} {yarn} {:.2}s {} ",
                t.elapsed().as_secs_f64(),
                r.certified
            );
            for f in &r.figures {
                print!("{} {:.6}  ", f.key, f.value);
            }
            println!();
        }
    }
    Ok(())
}
