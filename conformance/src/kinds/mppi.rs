//! MPPI: critics, update, filter, rollout.

use periplus_controllers::mppi::probe::{
    CriticScene, SampleTable, rollout, score, smooth_sequence, update_sequence,
};
use periplus_controllers::mppi::{
    ControlHistory, ControlSequence, CriticKind, MppiAccelerationLimits, MppiControl, MppiModel,
    MppiVelocityLimits,
};
use periplus_costmap::{Costmap, CostmapView, Footprint, Nav2Release};
use periplus_diagnostics::Diagnostics;
use periplus_geometry::Pose2;
use periplus_grid::GridInfo;
use periplus_params::{Given, ParamValues, Table};
use serde_json::{Value, json};

use super::Setting;
use crate::{Case, CaseReader, Differences, Unreadable, numbers};

type Checked = Result<(), Unreadable>;

fn release_of(distro: &str) -> Result<Nav2Release, Unreadable> {
    distro.parse().map_err(|why| Unreadable(format!("`distro`: {why}")))
}

fn single(reader: &CaseReader<'_>) -> Result<f32, Unreadable> {
    Ok(reader.number()? as f32)
}

fn singles(reader: &CaseReader<'_>) -> Result<Vec<f32>, Unreadable> {
    reader.each(single)
}

/// Rows of a matrix.
fn matrix(given: &CaseReader<'_>, name: &str) -> Result<Vec<Vec<f32>>, Unreadable> {
    given.get(name)?.each(singles)
}

fn pose(reader: &CaseReader<'_>) -> Result<[f32; 3], Unreadable> {
    Ok(reader.array::<3>()?.map(|it| it as f32))
}

fn doubles(values: &[f32]) -> Value {
    numbers(values.iter().copied().map(f64::from))
}

/// Values of a critic's parameters; those of other critics have no influence.
fn critic_values(
    table: &'static Table,
    params: &CaseReader<'_>,
) -> Result<ParamValues, Unreadable> {
    let mut written = Vec::new();
    for (name, value) in params.members()? {
        if table.find(name).is_some() {
            written.push((name, value.written()));
        } else {
            value.skip();
        }
    }
    let mut diagnostics = Diagnostics::new();
    let given = written.iter().map(|(name, text)| Given::new(name, text.as_str()));
    let values = table.check_given(given, &mut diagnostics);
    match diagnostics.iter().next() {
        Some(wrong) => Err(params.unreadable(&wrong.message)),
        None => Ok(values),
    }
}

fn costmap_of(reader: &CaseReader<'_>) -> Result<Costmap, Unreadable> {
    let (width, height) = reader.get("size")?.cell()?;
    let [x_m, y_m] = reader.get("origin")?.array()?;
    let info = GridInfo::new(
        reader.get("resolution")?.number()?,
        width,
        height,
        Pose2::new(x_m, y_m, 0.0),
    )
    .map_err(|error| reader.unreadable(&error.to_string()))?;
    let mut costmap = Costmap::new(info, reader.get("default_cost")?.byte()?);
    for cell in reader.get("cells")?.list()? {
        let [x, y, cost] = cell.array::<3>()?;
        costmap.set((x as usize, y as usize), cost as u8);
    }
    Ok(costmap)
}

/// Costs that a critic adds to each sample.
pub(super) fn check_critic(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Checked {
    let (given, expect) = (case.given(), case.expect());
    let params = given.get("params")?;
    let name = given.get("critic")?;
    let kind =
        CriticKind::of_name(name.text()?).ok_or_else(|| name.unreadable("a critic of MPPI"))?;
    let values = critic_values(kind.table(), &params)?;
    let parameter = |name: &str| single(&params.get(name)?);
    let model = given.get("motion_model")?;
    let model = match model.text()? {
        "diff_drive" => MppiModel::DiffDrive,
        "omni" => MppiModel::Omni,
        "ackermann" => MppiModel::Ackermann {
            min_turning_radius_m: parameter("min_turning_r")?,
            samples_curvatures: false,
        },
        _ => return Err(model.unreadable("`diff_drive`, `omni` or `ackermann`")),
    };
    let table = SampleTable {
        vx: matrix(&given, "vx")?,
        vy: matrix(&given, "vy")?,
        wz: matrix(&given, "wz")?,
        x: matrix(&given, "x")?,
        y: matrix(&given, "y")?,
        yaw: matrix(&given, "yaw")?,
    };
    let path = given.get("path")?.each(pose)?;
    let costmap = given.get("costmap")?;
    let costs = costmap_of(&costmap)?;
    let footprint = Footprint::circle(0.2);
    let scene = CriticScene {
        release: release_of(distro)?,
        model,
        step_s: single(&given.get("model_dt")?)?,
        limits: MppiVelocityLimits {
            vx_max: parameter("vx_max")?,
            vx_min: parameter("vx_min")?,
            vy_max: parameter("vy_max")?,
            wz_max: f32::INFINITY,
        },
        robot: pose(&given.get("robot_pose")?)?,
        goal: path.last().copied().unwrap_or_default(),
        path,
        path_length: single(&given.get("local_path_length")?)?,
        goal_tolerance: Some(parameter("xy_goal_tolerance")?),
        furthest: Some(given.get("furthest_point")?.count()?),
        valid: Some(given.get("path_valid")?.each(CaseReader::truth)?),
        costmap: CostmapView {
            costs: &costs,
            footprint: &footprint,
            is_circular: true,
            tracks_unknown: costmap.get("track_unknown_space")?.truth()?,
            inflation: None,
        },
    };
    let (costs, has_failed) = score(kind, &values, &scene, &table);
    let got = [(&["costs"][..], doubles(&costs)), (&["fail_flag"], json!(has_failed))];
    differences.compare_members(&got, &expect);
    Ok(())
}

fn sequence(vx: Vec<f32>, wz: Vec<f32>) -> ControlSequence {
    ControlSequence { vy: vec![0.0; vx.len()], vx, wz }
}

/// Weighted mean of the samples.
pub(super) fn check_update(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Checked {
    let (given, expect) = (case.given(), case.expect());
    let number = |name: &str| single(&given.get(name)?);
    let before = sequence(singles(&given.get("vx")?)?, singles(&given.get("wz")?)?);
    let controls = SampleTable {
        vx: matrix(&given, "cvx")?,
        wz: matrix(&given, "cwz")?,
        ..SampleTable::default()
    };
    let result = update_sequence(
        &before,
        &controls,
        &singles(&given.get("critic_costs")?)?,
        number("temperature")?,
        number("gamma")?,
        [number("vx_std")?, number("wz_std")?],
    );
    differences.compare_members(
        &[
            (&["costs"], doubles(&result.costs)),
            (&["weights"], doubles(&result.weights)),
            (&["vx"], doubles(&result.sequence.vx)),
            (&["wz"], doubles(&result.sequence.wz)),
        ],
        &expect,
    );
    Ok(())
}

/// Savitzky-Golay filter of one axis.
pub(super) fn check_filter(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Checked {
    let (given, expect) = (case.given(), case.expect());
    let values = singles(&given.get("sequence")?)?;
    let before = sequence(values.clone(), vec![0.0; values.len()]);
    let history: ControlHistory = given
        .get("history")?
        .array::<4>()?
        .map(|vx| MppiControl { vx: vx as f32, ..MppiControl::default() });
    let order = given.get("sgf_order")?.integer()?;
    let after = smooth_sequence(&before, &history, order, release_of(distro)?);
    differences.compare_members(&[(&["sequence"], doubles(&after.vx))], &expect);
    Ok(())
}

/// Motion of one sample of a differential drive.
pub(super) fn check_rollout(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Checked {
    let (given, expect) = (case.given(), case.expect());
    let constraints = given.get("constraints")?;
    let limit = |name: &str| single(&constraints.get(name)?);
    let limits = MppiAccelerationLimits {
        ax_max: limit("ax_max")?,
        ax_min: limit("ax_min")?,
        ay_max: 0.0,
        ay_min: 0.0,
        az_max: limit("az_max")?,
    };
    let controls = sequence(singles(&given.get("cvx")?)?, singles(&given.get("cwz")?)?);
    let [vx, vy, wz] = pose(&given.get("speed")?)?;
    let result = rollout(
        MppiModel::DiffDrive,
        &controls,
        pose(&given.get("pose")?)?,
        MppiControl { vx, vy, wz },
        &limits,
        single(&given.get("model_dt")?)?,
    );
    let row = |rows: &[Vec<f32>]| doubles(rows.first().map_or(&[], Vec::as_slice));
    differences.compare_members(
        &[
            (&["vx"], row(&result.vx)),
            (&["wz"], row(&result.wz)),
            (&["x"], row(&result.x)),
            (&["y"], row(&result.y)),
            (&["yaw"], row(&result.yaw)),
        ],
        &expect,
    );
    Ok(())
}
