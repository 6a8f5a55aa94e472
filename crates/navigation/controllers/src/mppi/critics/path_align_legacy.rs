//! `PathAlignLegacyCritic`: distance to the nearest point of the path (Humble).

use super::CriticContext;
use super::path_align::PathAlignCritic;
use crate::mppi::lane_math::normalize_angle;
use crate::mppi::lanes::{LANES, Row, ZEROS};
use crate::mppi::samples::Samples;

/// Adds the mean distance of a trajectory's points to the nearest points of the path. Points that are nearest
/// to the start of the path or to an obstacle on it cost nothing.
pub(super) fn score(
    critic: &PathAlignCritic,
    context: &CriticContext<'_>,
    samples: &Samples,
    costs: &mut [Row],
) {
    let path = context.path;
    if critic.reached(context, samples).is_none() || path.last() < 1 {
        return;
    }
    let compared = samples.steps / critic.point_step;
    let scale = 1.0 / compared.max(1) as f32;
    for (block, costs) in costs.iter_mut().enumerate() {
        let (x, y) = (samples.x.block(block), samples.y.block(block));
        let yaw = samples.yaw.block(block);
        let mut total = ZEROS;
        for at in (critic.point_step..samples.steps).step_by(critic.point_step) {
            let (mut lowest, mut nearest) = ([f32::INFINITY; LANES], [0_usize; LANES]);
            for index in 0..path.last() - 1 {
                let (px, py, pyaw) = (path.x[index], path.y[index], path.yaw[index]);
                for lane in 0..LANES {
                    let (dx, dy) = (px - x[at][lane], py - y[at][lane]);
                    let turn = if critic.uses_headings {
                        normalize_angle(yaw[at][lane] - pyaw)
                    } else {
                        0.0
                    };
                    let square = dx * dx + dy * dy + turn * turn;
                    if square < lowest[lane] {
                        (lowest[lane], nearest[lane]) = (square, index);
                    }
                }
            }
            for lane in 0..LANES {
                if nearest[lane] != 0 && context.is_valid(nearest[lane]) {
                    total[lane] += lowest[lane].sqrt();
                }
            }
        }
        critic.weighting.add(costs, &total.map(|total| total * scale));
    }
}
