//! What is published of a costmap.

use periplus_costmap::{Outgoing, Publication, Window, cost};

use super::super::Setting;
use super::costmap_of;
use crate::{Case, Differences, Reader, Unreadable};

/// Kind `costmap_publisher`: full grids or parts of them.
pub(in super::super) fn check(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let always = given.get("always_send_full_costmap")?.each(Reader::truth)?;
    let full = expect.get("full_messages")?.each(Reader::count)?;
    let parts = expect.get("update_messages")?.each(Reader::count)?;
    for (always_full, (full, parts)) in always.into_iter().zip(full.into_iter().zip(parts)) {
        let mut costmap = costmap_of(&given, "initial_cost")?;
        let mut publication = Publication::new();
        let mut sent_full = 0;
        let mut updates = Vec::new();
        for change in given.get("changes")?.list()? {
            for cell in change.get("set")?.list()? {
                match *cell.each(Reader::count)?.as_slice() {
                    [x, y, cost @ 0..=255] => costmap.set((x, y), cost as u8),
                    _ => return Err(cell.unreadable("a column, a row and a cost")),
                }
            }
            let count = |name: &str| change.get(name)?.count();
            let (x0, xn, y0, yn) = (count("x0")?, count("xn")?, count("y0")?, count("yn")?);
            publication.changed(Window { x0, y0, xn, yn });
            match publication.next(costmap.lattice(), always_full) {
                Outgoing::Nothing => {}
                Outgoing::Full => sent_full += 1,
                Outgoing::Update(window) => {
                    let spans = window.spans(costmap.lattice().width);
                    let data: Vec<u8> =
                        spans.flat_map(|span| costmap.costs()[span].to_vec()).collect();
                    updates.push((window, data));
                }
            }
        }
        let when = format!("always_send_full_costmap {always_full}");
        differences.same(format_args!("{when}, full"), &sent_full, &full);
        differences.same(format_args!("{when}, updates"), &updates.len(), &parts);
        if parts == 0 {
            continue;
        }
        let Some(payloads) = expect.find("update_payloads") else { continue };
        for ((window, data), expected) in updates.iter().zip(payloads.list()?) {
            let [x, y, width, height] =
                ["x", "y", "width", "height"].map(|name| expected.get(name));
            let place = [x?.count()?, y?.count()?, width?.count()?, height?.count()?];
            let got = [window.x0, window.y0, window.width(), window.height()];
            differences.same(format_args!("{when}, place"), &got, &place);
            if let Some(raw) = expected.find("data_raw") {
                differences.same(format_args!("{when}, raw"), data, &raw.each(Reader::byte)?);
            }
            if let Some(occupancy) = expected.find("data_occupancy") {
                let got: Vec<i64> = data.iter().map(|it| cost::occupancy_of(*it).into()).collect();
                differences.same(
                    format_args!("{when}, map"),
                    &got,
                    &occupancy.each(Reader::integer)?,
                );
            }
        }
    }
    Ok(())
}
