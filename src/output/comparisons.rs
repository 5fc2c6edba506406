//! The laboratory's comparisons, as JSON and as a table in Markdown.

use crate::lab::Comparison;
use serde::Serialize;

#[derive(Serialize)]
struct Table<'a> {
    format: &'static str,
    rows: Vec<Row<'a>>,
}

#[derive(Serialize)]
struct Row<'a> {
    test: &'a str,
    quantity: &'static str,
    figure: f64,
    reference: f64,
    allowed: String,
    pass: Option<bool>,
    source: &'static str,
}

/// All comparisons as JSON text (`soen-verify/1`); `pass` is `null` where a figure is shown only.
#[must_use]
pub fn comparisons(rows: &[Comparison]) -> String {
    let rows = rows.iter().map(|row| Row {
        test: &row.test,
        quantity: row.quantity,
        figure: row.figure,
        reference: row.reference,
        allowed: row.allowance(),
        pass: row.passes(),
        source: row.source,
    });
    let table = Table {
        format: "soen-verify/1",
        rows: rows.collect(),
    };
    // Text and numbers cannot fail to become JSON.
    serde_json::to_string_pretty(&table).unwrap_or_default() + "\n"
}

/// All comparisons as a table in Markdown.
#[must_use]
pub fn comparison_table(rows: &[Comparison]) -> String {
    let head = "| | Test | Quantity | Ours | Reference | Allowed | Source |\n|---|---|---|---|---|---|---|\n";
    let line = |row: &Comparison| {
        let verdict = match row.passes() {
            Some(true) => "pass",
            Some(false) => "**miss**",
            None => "shown",
        };
        format!(
            "| {verdict} | {} | {} | {:.5} | {:.5} | {} | {} |\n",
            row.test,
            row.quantity,
            row.figure,
            row.reference,
            row.allowance(),
            row.source
        )
    };
    core::iter::once(head.to_owned())
        .chain(rows.iter().map(line))
        .collect()
}
