//! Observations of the agents of an environment.

use periplus_geometry::Twist2;

use super::environment::{Agent, EnvironmentRecord};
use super::{NavigationSettings, Scratch};
use crate::footprint::bearing_rad;
use crate::observation::{GOAL_SCALE_M, ObservationPart, ObservationSlice, write_sector_minimums};
use crate::parameters::DriveKind;
use crate::reward::AgentState;

/// Writes a row for each agent.
pub(super) fn write_all(
    record: &EnvironmentRecord,
    agents: &[Agent],
    settings: &NavigationSettings,
    layout: &[ObservationSlice],
    scratch: &mut Scratch,
    observations: &mut [f32],
) {
    let columns = observations.len() / agents.len();
    let is_of_lidar = |part| matches!(part, ObservationPart::Ranges | ObservationPart::Sectors);
    let has_lidar = layout.iter().any(|slice| is_of_lidar(slice.part));
    let mut ranges = std::mem::take(&mut scratch.ranges);
    for (at, row) in observations.chunks_mut(columns).enumerate() {
        if has_lidar {
            ranges.resize(settings.robot.params().lidar_beams, 0.0);
            measure_ranges(record, agents, at, settings, scratch, &mut ranges);
        }
        for slice in layout {
            let numbers = &mut row[slice.start..slice.start + slice.low.len()];
            match slice.part {
                ObservationPart::Ranges => numbers.copy_from_slice(&ranges),
                ObservationPart::Sectors => write_sector_minimums(&ranges, numbers),
                part => write_state(part, &agents[at], settings, numbers),
            }
        }
    }
    scratch.ranges = ranges;
}

fn measure_ranges(
    record: &EnvironmentRecord,
    agents: &[Agent],
    at: usize,
    settings: &NavigationSettings,
    scratch: &mut Scratch,
    ranges_m: &mut [f32],
) {
    let (robot, agent) = (&settings.robot, &agents[at]);
    robot.cast(&settings.worlds[record.world], agent.pose, &mut scratch.rays, ranges_m);
    let max_m = robot.params().lidar_max_range_m;
    for other in (0..agents.len()).filter(|other| *other != at) {
        // Robots at their goals have left.
        if agents[other].state == AgentState::Reached {
            continue;
        }
        let placed = robot.footprint().placed(agents[other].pose, &mut scratch.other_corners);
        for (ray, range) in scratch.rays.iter().zip(ranges_m.iter_mut()) {
            let origin = [ray.origin_m.x, ray.origin_m.y];
            let found_m = placed.range_m(origin, [ray.direction.x, ray.direction.y]);
            if found_m <= max_m {
                #[expect(clippy::cast_possible_truncation, reason = "single precision")]
                let found = found_m as f32;
                *range = range.min(found);
            }
        }
    }
    let has_noise = robot.params().lidar_noise_m > 0.0;
    let mut noise = has_noise.then(|| record.stream("lidar", at));
    robot.finish_ranges(ranges_m, noise.as_mut());
    if settings.task.is_normalized {
        #[expect(clippy::cast_possible_truncation, reason = "single precision")]
        let max = max_m as f32;
        ranges_m.iter_mut().for_each(|range| *range /= max);
    }
}

fn write_state(
    part: ObservationPart,
    agent: &Agent,
    settings: &NavigationSettings,
    numbers: &mut [f32],
) {
    let params = settings.robot.params();
    let is_normalized = settings.task.is_normalized;
    let polar = |angle_rad: f64| {
        let (sine, cosine) = libm::sincos(angle_rad);
        [cosine, sine]
    };
    #[expect(clippy::cast_possible_truncation, reason = "observations are in single precision")]
    let mut write = |values: &[f64]| {
        for (number, value) in numbers.iter_mut().zip(values) {
            *number = *value as f32;
        }
    };
    match part {
        ObservationPart::Ranges | ObservationPart::Sectors => {}
        ObservationPart::Goal => {
            let [cosine, sine] = polar(bearing_rad(agent.pose, agent.goal_m));
            let distance = if is_normalized {
                (agent.goal_distance_m / GOAL_SCALE_M).min(1.0)
            } else {
                agent.goal_distance_m
            };
            write(&[distance, cosine, sine]);
        }
        ObservationPart::Velocity => {
            let Twist2 { mut vx_m_s, mut vy_m_s, mut wz_rad_s } = agent.velocity;
            if is_normalized {
                vx_m_s /= params.max_speed_m_s.max(params.min_speed_m_s.abs());
                vy_m_s /= params.max_lateral_speed_m_s.max(f64::MIN_POSITIVE);
                wz_rad_s /= params.max_turn_rate_rad_s;
            }
            match params.drive {
                DriveKind::Differential => write(&[vx_m_s, wz_rad_s]),
                DriveKind::Omni => write(&[vx_m_s, vy_m_s, wz_rad_s]),
            }
        }
        ObservationPart::Pose => {
            let [cosine, sine] = polar(agent.pose.yaw_rad);
            write(&[agent.pose.x_m, agent.pose.y_m, cosine, sine]);
        }
        ObservationPart::PreviousAction => numbers.copy_from_slice(&agent.action[..numbers.len()]),
    }
}
