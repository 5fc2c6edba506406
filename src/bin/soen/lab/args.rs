//! The instruments' options, with their help and their defaults.

use clap::{Args, Subcommand, ValueEnum};
use soen::{fabric::Yarn, lab::Cut};
use std::path::PathBuf;

#[derive(Args, Debug)]
pub(crate) struct LabWish {
    #[command(subcommand)]
    pub(crate) test: Test,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Test {
    /// A strip hangs under its own weight, or is pulled: the S–S curve.
    Strip {
        #[command(flatten)]
        of: Specimen,
        #[command(flatten)]
        along: Along,
        /// Length of the strip [cm].
        #[arg(long, value_name = "CM", default_value_t = 20.0)]
        length: f64,
        /// Pulls the strip, 2.5 cm wide, to this strain, as a fraction.
        #[arg(long, value_name = "STRAIN")]
        pull: Option<f64>,
    },
    /// A strip clamped level bends under its own weight.
    Cantilever {
        #[command(flatten)]
        of: Specimen,
        #[command(flatten)]
        along: Along,
        /// Free length [cm]. Where not given, the length is found at which the tip meets the
        /// instrument's slope of 41.5°, and the bending that relation (2) makes of it.
        #[arg(long, value_name = "CM")]
        overhang: Option<f64>,
    },
    /// A sheet between two clamps that move along each other under a load (KES-F1-S).
    ///
    /// A corner of the lattice has the mean of both yarns' moduli, so either direction shows that.
    /// A sheet that stands out of its plane has wrinkled, and shows less.
    Shear {
        #[command(flatten)]
        of: Specimen,
        #[command(flatten)]
        along: Along,
        /// Load that keeps the sheet taut [gf]; where not given, 200 or, if that is more, four times
        /// what shears it. Where it is 0, hinged sides keep the clamps at the yarns' length, and
        /// limp cloth wrinkles.
        #[arg(long, value_name = "GF")]
        load: Option<f64>,
        /// Greatest angle [°].
        #[arg(long, value_name = "DEG", default_value_t = 8.0)]
        angle: f64,
    },
    /// A strip hangs as a heart from its two ends (Peirce; ASTM D1388 B).
    HeartLoop {
        #[command(flatten)]
        of: Specimen,
        #[command(flatten)]
        along: Along,
        /// Length of the strip [cm]; ten bending lengths where not given.
        #[arg(long, value_name = "CM")]
        length: Option<f64>,
    },
    /// A disc of 30 cm rests on one of 18 cm (Cusick): drape coefficient and folds, over seeds.
    Drapemeter {
        #[command(flatten)]
        of: Specimen,
        /// How often the cloth is laid anew.
        #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=1000))]
        seeds: u32,
    },
    /// The drapemeter at a pitch, a half and a quarter of it: the order of the errors, and the pitch
    /// that keeps each figure within 1 %.
    Resolution {
        #[command(flatten)]
        of: Specimen,
        /// Layings at each pitch.
        #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u32).range(1..=100))]
        seeds: u32,
    },
    /// A plane is raised until the cloth on it slides.
    Slope {
        #[command(flatten)]
        of: Specimen,
        /// Coulomb friction; the fabric's against a body where not given.
        #[arg(long, value_name = "µ")]
        friction: Option<f64>,
    },
    /// A belt hangs over a cylinder: the heaviest end that friction holds.
    Capstan {
        #[command(flatten)]
        of: Specimen,
        #[command(flatten)]
        along: Along,
        /// Coulomb friction; the fabric's against a body where not given.
        #[arg(long, value_name = "µ")]
        friction: Option<f64>,
    },
    /// Strips cut along warp, weft and bias bend: B45 against both, with twist and without.
    BiasBend {
        #[command(flatten)]
        of: Specimen,
        /// Twist modulus to bend it with [gf·cm]; where not given, the fabric's or, where that is 0,
        /// what makes B45 0.78 of the mean, as measured cloth has it.
        #[arg(long, value_name = "GF_CM")]
        twist: Option<f64>,
    },
    /// A strip on edge, clamped at one end, grows until it buckles sideways.
    Buckling {
        #[command(flatten)]
        of: Specimen,
        #[command(flatten)]
        along: Along,
        /// Takes its yarns and its shear as rigid, as the theory does.
        #[arg(long)]
        rigid: bool,
        /// Twist modulus [gf·cm]; the fabric's where not given.
        #[arg(long, value_name = "GF_CM")]
        twist: Option<f64>,
    },
    /// A strip clamped upright is lowered onto a floor until its tip slips.
    StickSlip {
        #[command(flatten)]
        of: Specimen,
        #[command(flatten)]
        along: Along,
        /// Coulomb friction, up to 0.37; the fabric's against a body where not given.
        #[arg(long, value_name = "µ")]
        friction: Option<f64>,
    },
    /// Compares the simulated cloth with theory and with what was published, in one table.
    Verify {
        /// Prints the table as JSON.
        #[arg(long)]
        json: bool,
        /// Folder for table.json and table.md.
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
        /// Leaves out what takes minutes.
        #[arg(long)]
        quick: bool,
    },
}

#[derive(Args, Debug)]
pub(crate) struct Specimen {
    /// One of the fabrics that ship, a file in fabrics/, or a path to a .toml.
    #[arg(long, value_name = "NAME")]
    pub(crate) fabric: String,
    /// Pitch of the lattice [cm]; where not given, what the instrument needs.
    #[arg(long, value_name = "CM")]
    pub(crate) pitch: Option<f64>,
    /// Prints the reading as JSON, alone.
    #[arg(long)]
    pub(crate) json: bool,
    /// Folder for reading.json, curve.csv, curve.svg, drape.png and drape.obj.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

#[derive(Args, Debug)]
pub(crate) struct Along {
    /// Which way the specimen is cut.
    #[arg(long, value_enum, default_value_t = Direction::Warp)]
    pub(crate) direction: Direction,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Direction {
    Warp,
    Weft,
}

impl Direction {
    pub(crate) fn yarn(self) -> Yarn {
        match self {
            Self::Warp => Yarn::Warp,
            Self::Weft => Yarn::Weft,
        }
    }

    pub(crate) fn cut(self) -> Cut {
        self.yarn().into()
    }
}
