//! The five fabrics of the paper's tables 1 and 2, kept in the program so that their names work
//! anywhere.

/// Name and file text of each fabric that ships.
pub const SWATCHES: [(&str, &str); 5] = [
    ("a", include_str!("../../fabrics/a.toml")),
    ("b", include_str!("../../fabrics/b.toml")),
    ("c", include_str!("../../fabrics/c.toml")),
    ("d", include_str!("../../fabrics/d.toml")),
    ("washi", include_str!("../../fabrics/washi.toml")),
];

/// The file text of a fabric that ships, by its name.
pub fn swatch(name: &str) -> Option<&'static str> {
    SWATCHES
        .iter()
        .find(|(known, _)| *known == name)
        .map(|(_, text)| *text)
}
