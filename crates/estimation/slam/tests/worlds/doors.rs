//! Doors that open and close between passes and while the robot looks; and the same rooms for a
//! scanner that sees 4 m, and for one that cost little.

use super::Moment;
use super::office::{Office, PLAIN, Style};
use super::rig::RIG;

const WITH_DOORS: Style = Style { has_doors: true, ..PLAIN };

pub(crate) fn doors(seed: u64, is_short: bool) -> Vec<Moment> {
    let office = Office::new(seed, WITH_DOORS);
    let rig = RIG.with_scanner(if seed.is_multiple_of(2) { 270 } else { 180 }, 15.0);
    let rig = rig.with_wheels(seed / 2 % 2 == 1);
    let corners = office.rounds(is_short);
    rig.drive(office.scene, &corners, seed)
}

pub(crate) fn near_sighted(seed: u64, is_short: bool) -> Vec<Moment> {
    let office = Office::new(seed, PLAIN);
    let rig = RIG.with_scanner(if seed.is_multiple_of(2) { 270 } else { 180 }, 4.0);
    let rig = rig.with_wheels(seed / 2 % 2 == 1);
    let corners = office.rounds(is_short);
    rig.drive(office.scene, &corners, seed)
}

pub(crate) fn low_cost(seed: u64, is_short: bool) -> Vec<Moment> {
    let office = Office::new(seed, WITH_DOORS);
    let rig = RIG.low_cost().with_wheels(seed % 2 == 1);
    let corners = office.rounds(is_short);
    rig.drive(office.scene, &corners, seed)
}
