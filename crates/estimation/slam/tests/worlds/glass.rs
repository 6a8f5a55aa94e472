//! Corridors between panes of glass, which most rays pass.

use super::Moment;
use super::office::{Office, PLAIN, Style};
use super::rig::{RIG, Rig};

pub(crate) fn glass(seed: u64, is_short: bool) -> Vec<Moment> {
    let office = Office::new(seed, Style { is_glazed: true, ..PLAIN });
    let rig: Rig = RIG.with_scanner(if seed.is_multiple_of(2) { 270 } else { 180 }, 20.0);
    let rig = rig.with_wheels(seed / 2 % 2 == 1);
    let corners = office.rounds(is_short);
    rig.drive(office.scene, &corners, seed)
}
