//! Published messages of a costmap.

use periplus_costmap::{CellWindow, CostmapMessage, PublicationState, cost};

use serde_json::{Value, json};

use super::super::Setting;
use super::costmap_of;
use crate::{Case, CaseReader, Differences, Unreadable};

/// Kind `costmap_publisher`: full grids or parts of them.
pub(in super::super) fn check(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let always = given.get("always_send_full_costmap")?.each(CaseReader::truth)?;
    let (mut full, mut parts, mut payloads) = (Vec::new(), Vec::new(), Vec::new());
    for always_full in always {
        let mut costmap = costmap_of(&given, "initial_cost")?;
        let mut publication = PublicationState::new();
        let mut sent_full = 0;
        let mut updates = Vec::new();
        for change in given.get("changes")?.list()? {
            for cell in change.get("set")?.list()? {
                match *cell.each(CaseReader::count)?.as_slice() {
                    [x, y, cost @ 0..=255] if costmap.info().contains((x, y)) => {
                        costmap.set((x, y), cost as u8);
                    }
                    _ => return Err(cell.unreadable("a column, a row and a cost")),
                }
            }
            let count = |name: &str| change.get(name)?.count();
            let (x0, xn, y0, yn) = (count("x0")?, count("xn")?, count("y0")?, count("yn")?);
            publication.changed(CellWindow { x0, y0, xn, yn });
            match publication.next(costmap.info(), always_full) {
                CostmapMessage::Nothing => {}
                CostmapMessage::Full => sent_full += 1,
                CostmapMessage::Update(window) => {
                    let spans = window.spans(costmap.info().width);
                    let data: Vec<u8> =
                        spans.flat_map(|span| costmap.costs()[span].to_vec()).collect();
                    let occupancy: Vec<i8> =
                        data.iter().map(|cost| cost::occupancy_of(*cost)).collect();
                    updates.push(json!({
                        "x": window.x0, "y": window.y0,
                        "width": window.width(), "height": window.height(),
                        "data_raw": data, "data_occupancy": occupancy,
                    }));
                }
            }
        }
        full.push(sent_full);
        parts.push(updates.len());
        if !updates.is_empty() {
            payloads = updates;
        }
    }
    differences.compare_members(
        &[
            (&["full_messages"], json!(full)),
            (&["update_messages"], json!(parts)),
            (&["update_payloads"], Value::Array(payloads)),
        ],
        &expect,
    );
    Ok(())
}
