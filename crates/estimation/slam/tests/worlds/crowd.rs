//! A crowd: people who walk to and fro, and groups that walk along with the robot.

use periplus_geometry::Stream;

use super::Moment;
use super::office::{DEEP_M, LONG_M, Office, PLAIN, Style};
use super::rig::RIG;
use super::solid::Walker;

/// Half the width of corridors in which a crowd has room \[m\].
const HALF_M: f64 = 1.6;

pub(crate) fn crowd(seed: u64, is_short: bool) -> Vec<Moment> {
    let mut office = Office::new(seed, Style { half_m: HALF_M, ..PLAIN });
    let mut stream = Stream::keyed(seed, "crowd", 0);
    let people = 20 + (40.0 * stream.unit()) as usize;
    let ways = [
        [[0.0, 0.0], [LONG_M, 0.0]],
        [[LONG_M, 0.0], [LONG_M, DEEP_M]],
        [[LONG_M, DEEP_M], [0.0, DEEP_M]],
        [[0.0, DEEP_M], [0.0, 0.0]],
        [[0.5 * LONG_M, 0.0], [0.5 * LONG_M, DEEP_M]],
    ];
    for _ in 0..people {
        let way = ways[(stream.unit() * ways.len() as f64) as usize];
        let aside = [1.2 * (2.0 * stream.unit() - 1.0), 1.2 * (2.0 * stream.unit() - 1.0)];
        let corners = way.map(|[x, y]| [x + aside[0], y + aside[1]]).to_vec();
        let (speed_m_s, start_m) = (0.4 + 1.1 * stream.unit(), 200.0 * stream.unit());
        office.scene.walkers.push(Walker::Along { corners, speed_m_s, start_m });
    }
    // Now and then some come along for a while.
    let mut from_s = 10.0;
    while from_s < 600.0 {
        let to_s = from_s + 20.0 + 40.0 * stream.unit();
        for _ in 0..2 + (5.0 * stream.unit()) as usize {
            let ahead = 3.0 * stream.unit() - 0.5;
            let side = if stream.unit() < 0.5 { 1.0 } else { -1.0 };
            let beside = [ahead, side * (0.5 + 0.7 * stream.unit())];
            office.scene.walkers.push(Walker::With { beside, from_s, to_s });
        }
        from_s = to_s + 20.0 + 40.0 * stream.unit();
    }
    let rig = RIG.with_scanner(if seed.is_multiple_of(2) { 270 } else { 180 }, 20.0);
    let rig = rig.with_wheels(seed / 2 % 2 == 1);
    let corners = office.rounds(is_short);
    rig.drive(office.scene, &corners, seed)
}
