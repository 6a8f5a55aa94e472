//! Single stages of the controller, for tests with given samples instead of noise.

use std::cell::OnceCell;

use periplus_costmap::{CostmapView, Nav2Release};
use periplus_params::ParamValues;

use super::context::{CriticContext, Evaluation};
use super::cost_grid::CostGrid;
use super::critics::{Critic, CriticKind, CriticLimits};
use super::filter::{ControlHistory, smooth};
use super::lanes::{Row, ZEROS};
use super::limits::{MppiAccelerationLimits, MppiModel, MppiVelocityLimits};
use super::path::LocalPath;
use super::rollout::{Delays, Motion, NoiseScale, Start, predict};
use super::samples::Samples;
use super::sequence::{ControlSequence, MppiControl};
use super::update::{UpdateSettings, update};

/// Quantities of given samples: rows are samples, columns time steps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SampleTable {
    /// Velocities forwards \[m/s\].
    pub vx: Vec<Vec<f32>>,
    /// Velocities to the left \[m/s\]; may be empty.
    pub vy: Vec<Vec<f32>>,
    /// Turn rates \[rad/s\].
    pub wz: Vec<Vec<f32>>,
    /// Positions \[m\].
    pub x: Vec<Vec<f32>>,
    /// Positions \[m\].
    pub y: Vec<Vec<f32>>,
    /// Headings \[rad\].
    pub yaw: Vec<Vec<f32>>,
}

impl SampleTable {
    fn samples(&self, is_holonomic: bool) -> Samples {
        let steps = self.vx.first().map_or(0, Vec::len);
        let mut samples = Samples::new(self.vx.len(), steps, is_holonomic);
        let fields = [
            (&mut samples.vx.velocities, &self.vx),
            (&mut samples.vy.velocities, &self.vy),
            (&mut samples.wz.velocities, &self.wz),
            (&mut samples.x, &self.x),
            (&mut samples.y, &self.y),
            (&mut samples.yaw, &self.yaw),
        ];
        for (field, rows) in fields {
            for (sample, row) in rows.iter().enumerate() {
                for (step, value) in row.iter().enumerate() {
                    field.set(sample, step, *value);
                }
            }
        }
        samples
    }
}

/// Inputs of a critic.
#[derive(Clone, Debug)]
pub struct CriticScene<'a> {
    /// Release of Nav2 whose behaviour is used.
    pub release: Nav2Release,
    /// Motion model.
    pub model: MppiModel,
    /// Duration of a time step \[s\].
    pub step_s: f32,
    /// Limits of the velocity.
    pub limits: MppiVelocityLimits,
    /// Pose of the robot: x \[m\], y \[m\], yaw \[rad\].
    pub robot: [f32; 3],
    /// Poses of the path.
    pub path: Vec<[f32; 3]>,
    /// Length of the local path \[m\].
    pub path_length: f32,
    /// Last pose of the plan.
    pub goal: [f32; 3],
    /// Tolerance of the goal checker \[m\].
    pub goal_tolerance: Option<f32>,
    /// Index of the path point that the samples reach; found if none is given.
    pub furthest: Option<usize>,
    /// Points of the path that are free, one fewer than the path has; found if none are given.
    pub valid: Option<Vec<bool>>,
    /// Costs.
    pub costmap: CostmapView<'a>,
}

/// Returns the costs that a critic adds to each sample, and true if all samples collide.
#[must_use]
pub fn score(
    kind: CriticKind,
    values: &ParamValues,
    scene: &CriticScene<'_>,
    table: &SampleTable,
) -> (Vec<f32>, bool) {
    let MppiVelocityLimits { vx_max, vx_min, vy_max, .. } = scene.limits;
    let critic = Critic::new(kind, values, CriticLimits { vx_max, vx_min, vy_max }, scene.release);
    let samples = table.samples(scene.model.is_holonomic());
    let path = LocalPath::new(scene.path.iter().copied());
    let mut grid = CostGrid::default();
    grid.copy(&scene.costmap, [0.0; 2]);
    let [x, y, yaw] = scene.robot;
    let context = CriticContext {
        release: scene.release,
        model: scene.model,
        step_s: scene.step_s,
        start: Start { x, y, yaw, speed: MppiControl::default() },
        path: &path,
        goal: scene.goal,
        ignores_goal_heading: false,
        goal_tolerance: scene.goal_tolerance,
        grid: &grid,
        path_length: scene.path_length,
        furthest: scene.furthest.map(OnceCell::from).unwrap_or_default(),
        valid: scene.valid.clone().map(OnceCell::from).unwrap_or_default(),
    };
    let mut evaluation = Evaluation::default();
    evaluation.clear(samples.blocks());
    critic.score(&context, &samples, &mut evaluation);
    (evaluation.costs.as_flattened()[..samples.count].to_vec(), evaluation.has_failed)
}

/// Result of an update.
#[derive(Clone, Debug, PartialEq)]
pub struct UpdateResult {
    /// Costs with the control cost.
    pub costs: Vec<f32>,
    /// Weights of the samples.
    pub weights: Vec<f32>,
    /// Sequence, before the filter and the limits.
    pub sequence: ControlSequence,
}

/// Updates a sequence from sampled controls (`vx` and `wz` of the table) and the costs of the critics.
/// `std` is the noise of `vx` \[m/s\] and `wz` \[rad/s\].
#[must_use]
pub fn update_sequence(
    sequence: &ControlSequence,
    controls: &SampleTable,
    critic_costs: &[f32],
    temperature: f32,
    gamma: f32,
    std: [f32; 2],
) -> UpdateResult {
    let mut samples = controls.samples(false);
    std::mem::swap(&mut samples.vx.controls, &mut samples.vx.velocities);
    std::mem::swap(&mut samples.wz.controls, &mut samples.wz.velocities);
    let mut costs: Vec<Row> = vec![ZEROS; samples.blocks()];
    for (cost, given) in costs.as_flattened_mut().iter_mut().zip(critic_costs) {
        *cost = *given;
    }
    let scale = NoiseScale { vx: std[0], vy: 0.0, wz: std[1] };
    let mut weights = Vec::new();
    let mut sequence = sequence.clone();
    let settings = UpdateSettings { temperature, gamma, scale };
    update(&mut sequence, &samples, &mut costs, &mut weights, &settings);
    let of_samples = |rows: &[Row]| rows.as_flattened()[..samples.count].to_vec();
    UpdateResult { costs: of_samples(&costs), weights: of_samples(&weights), sequence }
}

/// Smooths a sequence. `order` is 1 or 2.
#[must_use]
pub fn smooth_sequence(
    sequence: &ControlSequence,
    history: &ControlHistory,
    order: i64,
    release: Nav2Release,
) -> ControlSequence {
    let (mut sequence, mut history) = (sequence.clone(), *history);
    smooth(&mut sequence, &mut history, order, release, 1);
    sequence
}

/// Predicts the motion of one sample from its controls. The table has one row each.
#[must_use]
pub fn rollout(
    model: MppiModel,
    controls: &ControlSequence,
    pose: [f32; 3],
    speed: MppiControl,
    limits: &MppiAccelerationLimits,
    step_s: f32,
) -> SampleTable {
    let steps = controls.len();
    let mut samples = Samples::new(1, steps, model.is_holonomic());
    for step in 0..steps {
        let MppiControl { vx, vy, wz } = controls.at(step);
        samples.vx.controls.set(0, step, vx);
        samples.vy.controls.set(0, step, vy);
        samples.wz.controls.set(0, step, wz);
    }
    let [x, y, yaw] = pose;
    let motion = Motion {
        model,
        changes: limits.within(step_s),
        step_s,
        limits_controls: false,
        delays: &Delays::default(),
        sequence: controls,
    };
    predict(&mut samples, &Start { x, y, yaw, speed }, &motion);
    let row =
        |field: &super::samples::Field| vec![(0..steps).map(|step| field.at(0, step)).collect()];
    SampleTable {
        vx: row(&samples.vx.velocities),
        vy: row(&samples.vy.velocities),
        wz: row(&samples.wz.velocities),
        x: row(&samples.x),
        y: row(&samples.y),
        yaw: row(&samples.yaw),
    }
}
