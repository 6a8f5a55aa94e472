//! Rescue of messages from a damaged database.

use rusqlite::Connection;

use super::read::is_corrupt;

/// Table of the rescued rows: times, ids and topics.
pub(super) const TABLE: &str = "periplus_rescued";

/// Collects times, ids and topics of all readable messages in [`TABLE`] and returns their number.
/// The message table is scanned in the order of ids; damaged pages are skipped.
pub(super) fn rescue(connection: &Connection) -> rusqlite::Result<usize> {
    connection.execute_batch(&format!(
        "CREATE TEMP TABLE {TABLE}(timestamp, id, topic_id, PRIMARY KEY(timestamp, id)) WITHOUT ROWID"
    ))?;
    let mut found = 0;
    let mut from = i64::MIN;
    // Size of the skip over damaged ids, doubled each time so that the scan ends.
    let mut leapt: i64 = 0;
    loop {
        let up = walk(connection, from, i64::MAX, Order::Up)?;
        found += up.found;
        if leapt > 0 && (up.last.is_some() || !up.is_broken) {
            // The skip may be too far: scan the skipped ids backwards.
            found += walk(connection, from.saturating_sub(leapt), from, Order::Down)?.found;
        }
        if !up.is_broken {
            return Ok(found);
        }
        if let Some(last) = up.last {
            (from, leapt) = (last, 0);
        } else if from == i64::MIN {
            // Ids start at 1.
            from = 0;
        }
        leapt = (2 * leapt).max(1);
        match from.checked_add(leapt).filter(|next| *next < FURTHEST) {
            Some(next) => from = next,
            None => return Ok(found),
        }
    }
}

/// Upper limit of ids, far above any bag.
const FURTHEST: i64 = 1 << 48;

#[derive(Clone, Copy, PartialEq)]
enum Order {
    Up,
    Down,
}

/// Result of a scan.
struct Walk {
    found: usize,
    /// Id of the last row found.
    last: Option<i64>,
    is_broken: bool,
}

/// Collects the readable rows of a range of ids.
fn walk(connection: &Connection, from: i64, to: i64, order: Order) -> rusqlite::Result<Walk> {
    let word = if order == Order::Up { "ASC" } else { "DESC" };
    let mut statement = connection.prepare_cached(&format!(
        "SELECT id, timestamp, topic_id FROM messages WHERE id >= ?1 AND id < ?2 ORDER BY id {word}"
    ))?;
    let mut insert =
        connection.prepare_cached(&format!("INSERT OR IGNORE INTO {TABLE} VALUES (?1, ?2, ?3)"))?;
    let mut walk = Walk { found: 0, last: None, is_broken: false };
    let mut rows = statement.query([from, to])?;
    loop {
        let row = match rows.next() {
            Ok(Some(row)) => row,
            Ok(None) => return Ok(walk),
            Err(error) if is_corrupt(&error) => {
                walk.is_broken = true;
                return Ok(walk);
            }
            Err(error) => return Err(error),
        };
        let id: i64 = row.get(0)?;
        // A damaged tree may lead back, without end.
        let goes_on =
            walk.last.is_none_or(|last| (id > last) == (order == Order::Up) && id != last);
        if !goes_on {
            walk.is_broken = true;
            return Ok(walk);
        }
        walk.last = Some(id);
        // A row whose time is not a number is not a message.
        if let (Ok(time), Ok(topic)) = (row.get::<_, i64>(1), row.get::<_, i64>(2)) {
            walk.found += insert.execute([time, id, topic])?;
        }
    }
}
