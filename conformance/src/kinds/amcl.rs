//! AMCL: sensor and motion models, KLD-sampling, recovery, the saved pose.

use periplus_geometry::{Pose2, normalize_angle};
use periplus_grid::{Grid, GridInfo};
use periplus_localization::{
    AMCL, AmclCompat, BIN_M, BIN_RAD, BeamMixture, CellAlignment, CellState, KldSampling,
    LikelihoodAverages, LikelihoodMap, OmniMotion, PoseThreshold, RotTransRot, SavedPose,
    SensorModel, Settings, has_moved, product_weight, sum_of_cubes_weight,
};

use periplus_params::ParamValue as Parameter;
use serde_json::{Value, json};

use super::Setting;
use crate::{Case, CaseReader, Differences, Unreadable, number, numbers};

type Checked = Result<(), Unreadable>;

/// A number, or what it is by default.
fn usual(given: &CaseReader<'_>, name: &str, usual: f64) -> Result<f64, Unreadable> {
    given.find(name).map_or(Ok(usual), |it| it.number())
}

/// A whole number, or what it is by default.
fn count(given: &CaseReader<'_>, name: &str, usual: usize) -> Result<usize, Unreadable> {
    given.find(name).map_or(Ok(usual), |it| it.count())
}

/// Parameters of AMCL that a case lists for the record count as used: which of them have an influence
/// depends on the kind.
fn use_parameters(given: &CaseReader<'_>) -> Result<(), Unreadable> {
    for parameter in AMCL.parameters {
        let Some(value) = given.find(parameter.name) else { continue };
        Parameter::read(parameter, &value.written()).map_err(|why| {
            value.unreadable(&format!("a value for `{}`: it {why}", parameter.name))
        })?;
    }
    Ok(())
}

fn mixture(given: &CaseReader<'_>) -> Result<BeamMixture, Unreadable> {
    let usual = Settings::default().mixture;
    Ok(BeamMixture {
        hit: self::usual(given, "z_hit", usual.hit)?,
        short: self::usual(given, "z_short", usual.short)?,
        max: self::usual(given, "z_max", usual.max)?,
        random: self::usual(given, "z_rand", usual.random)?,
        sigma_hit_m: self::usual(given, "sigma_hit", usual.sigma_hit_m)?,
        lambda_short_per_m: self::usual(given, "lambda_short", usual.lambda_short_per_m)?,
    })
}

fn pose(reader: &CaseReader<'_>) -> Result<Pose2, Unreadable> {
    let [x_m, y_m, yaw_rad] = reader.array()?;
    Ok(Pose2::new(x_m, y_m, yaw_rad))
}

/// Sensor model of a case: its field, or by default from its name.
fn model(case: &Case) -> Result<SensorModel, Unreadable> {
    let given = case.given();
    let named = given.find_any(&["laser_model_type", "model"]);
    let word = named.map_or(Ok(case.id.as_str()), |it| it.text())?;
    Ok(if word.contains("prob") {
        SensorModel::LikelihoodFieldProb
    } else {
        SensorModel::LikelihoodField
    })
}

/// Pairs of what a beam measured and what it should have.
pub(super) fn check_beam(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Checked {
    let (given, expect) = (case.given(), case.expect());
    use_parameters(&given)?;
    let mixture = mixture(&given)?;
    let range_max_m = given.get("range_max")?.number()?;
    let pairs = given.get("pairs")?.each(CaseReader::array::<2>)?;
    let likelihoods: Vec<f64> = pairs
        .iter()
        .map(|[measured, map]| mixture.beam_range(*measured, *map, range_max_m))
        .collect();
    differences.compare_members(
        &[
            (&["p"], numbers(likelihoods.iter().copied())),
            (&["weight"], number(sum_of_cubes_weight(likelihoods))),
        ],
        &expect,
    );
    Ok(())
}

/// Distances of the ends of beams from walls; null outside of the map.
pub(super) fn check_likelihood(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Checked {
    let (given, expect) = (case.given(), case.expect());
    use_parameters(&given)?;
    let mixture = mixture(&given)?;
    let range_max_m = given.get("range_max")?.number()?;
    let outside_m = usual(&given, "laser_likelihood_max_dist", Settings::default().distance_max_m)?;
    let likelihoods = given.get("occ_dist")?.each(|distance| {
        let distance_m = if distance.is_null() { outside_m } else { distance.number()? };
        Ok(mixture.likelihood_field(distance_m, range_max_m))
    })?;
    let weight = match model(case)? {
        SensorModel::LikelihoodFieldProb => product_weight(likelihoods.iter().copied()),
        SensorModel::LikelihoodField | SensorModel::Beam => {
            sum_of_cubes_weight(likelihoods.iter().copied())
        }
    };
    differences
        .compare_members(&[(&["p"], numbers(likelihoods)), (&["weight"], number(weight))], &expect);
    Ok(())
}

/// Every how many beams of a scan one is used, and which ones.
pub(super) fn check_beams(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Checked {
    let (given, expect) = (case.given(), case.expect());
    use_parameters(&given)?;
    let named = given.find_any(&["range_count", "beams", "count", "n"]);
    let total = match (named, given.find("ranges")) {
        (Some(total), _) => total.count()?,
        (None, Some(ranges)) => ranges.numbers()?.len(),
        (None, None) => return Err(given.unreadable("an object with `range_count` or `ranges`")),
    };
    let max_beams = count(&given, "max_beams", Settings::default().beams.max_beams)?;
    let stride = model(case)?.beam_step().step(total, max_beams);
    let used: Vec<usize> = (0..total).step_by(stride).collect();
    differences.compare_members(
        &[
            (&["step", "stride"], json!(stride)),
            (&["used_beams", "count"], json!(used.len())),
            (&["indices", "used"], json!(used)),
        ],
        &expect,
    );
    Ok(())
}

/// Particles needed for numbers of bins.
pub(super) fn check_kld(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Checked {
    let (given, expect) = (case.given(), case.expect());
    use_parameters(&given)?;
    let usual = Settings::default().kld_sampling;
    let sampling = KldSampling {
        max_error: self::usual(&given, "pf_err", usual.max_error)?,
        quantile: self::usual(&given, "pf_z", usual.quantile)?,
        min_particles: count(&given, "min_particles", usual.min_particles)?,
        max_particles: count(&given, "max_particles", usual.max_particles)?,
    };
    let bins = given.get("k")?.each(CaseReader::count)?;
    let needed: Vec<usize> = bins.into_iter().map(|bins| sampling.particle_count(bins)).collect();
    differences.compare_members(
        &[(&["samples"], json!(needed)), (&["bin_size"], numbers([BIN_M, BIN_M, BIN_RAD]))],
        &expect,
    );
    Ok(())
}

/// Terms of the motion model, with tolerances.
pub(super) fn check_motion(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Checked {
    let given = case.given();
    use_parameters(&given)?;
    let mut alphas = [0.0; 5];
    let written = given.get_any(&["alpha", "alphas"])?;
    let values = written.numbers()?;
    if values.len() > alphas.len() {
        return Err(written.unreadable("five numbers at most"));
    }
    for (alpha, value) in alphas.iter_mut().zip(values) {
        *alpha = value;
    }
    let is_omni = match given.find_any(&["robot_model_type", "model"]) {
        Some(name) => Some(name.text()?.to_ascii_lowercase().contains("omni")),
        None => None,
    };
    let moves = given.get("moves")?.list()?;
    let expect = case.expect();
    for (name, expected) in expect.members()?.into_iter().filter(|(name, _)| *name != "result") {
        differences.not_known(format!("`{name}` at {} (known: `result`)", expected.path()));
    }
    let results = expect.get("result")?.list()?;
    differences.same_count("results", moves.len(), results.len());
    for (index, (motion, expected)) in moves.iter().zip(&results).enumerate() {
        let old = pose(&motion.get("old_pose")?)?;
        let delta = pose(&motion.get("delta")?)?;
        // In the frame of odometry, not in that of the robot.
        let new = Pose2::new(old.x_m + delta.x_m, old.y_m + delta.y_m, old.yaw_rad + delta.yaw_rad);
        let turns = RotTransRot::between(old, new);
        let (turns, turns_noise) = (turns, turns.noise(&alphas));
        let omni = OmniMotion::between(old, new);
        let omni_noise = omni.noise(&alphas);
        let has = |name: &&str| expected.has(name);
        let shows_omni = is_omni.unwrap_or(["sd_strafe", "sd_rot", "rot"].iter().any(has));
        for (name, expected) in expected.members()? {
            let (got, is_angle) = match name {
                "rot1" => (turns.rot1_rad, true),
                "rot2" => (turns.rot2_rad, true),
                "trans" => (turns.trans_m, false),
                "sd_rot1" => (turns_noise.rot1_rad, false),
                "sd_rot2" => (turns_noise.rot2_rad, false),
                "sd_trans" if shows_omni => (omni_noise.trans_m, false),
                "sd_trans" => (turns_noise.trans_m, false),
                "sd_rot" => (omni_noise.turn_rad, false),
                "sd_strafe" => (omni_noise.strafe_m, false),
                "rot" => (omni.turn_rad, true),
                "bearing" => (omni.bearing_rad, true),
                _ => {
                    differences.not_known(format!("`{}`", expected.path()));
                    continue;
                }
            };
            let what = format!("move {index}: {name}");
            if is_angle {
                // Half a turn to the left is half a turn to the right.
                let wanted = expected.input().number()?;
                let got = wanted + normalize_angle(got - wanted);
                differences.compare(what, &number(got), &expected);
            } else {
                differences.compare(what, &number(got), &expected);
            }
        }
    }
    Ok(())
}

/// Averages of likelihoods and the share of random particles; or which motions make a scan count.
pub(super) fn check_update(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Checked {
    let (given, expect) = (case.given(), case.expect());
    use_parameters(&given)?;
    let mut named: Vec<(&[&str], Value)> = Vec::new();
    if let Some(means) = given.find("w_avg") {
        let alphas = [
            usual(&given, "recovery_alpha_slow", 0.0)?,
            usual(&given, "recovery_alpha_fast", 0.0)?,
        ];
        let mut averages = LikelihoodAverages::default();
        let mut lists = [Vec::new(), Vec::new(), Vec::new()];
        for mean in means.numbers()? {
            averages.update(mean, alphas);
            let values = [averages.slow, averages.fast, averages.random_fraction()];
            lists.iter_mut().zip(values).for_each(|(list, value)| list.push(value));
        }
        let names: [&[&str]; 3] = [&["w_slow"], &["w_fast"], &["w_diff"]];
        named.extend(names.into_iter().zip(lists.map(numbers)));
    }
    if let Some(moves) = given.find_any(&["moves", "deltas"]) {
        let default = Settings::default().update_threshold;
        let threshold = PoseThreshold::new(
            usual(&given, "update_min_d", default.distance_m)?,
            usual(&given, "update_min_a", default.angle_rad)?,
        );
        let got = moves.each(|delta| Ok(has_moved(Pose2::IDENTITY, pose(delta)?, threshold)))?;
        named.push((&["update", "updates", "result"], json!(got)));
    }
    differences.compare_members(&named, &expect);
    Ok(())
}

/// Values of cells, and the cell of a point, in Nav2's AMCL.
pub(super) fn check_map(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Checked {
    let (given, expect) = (case.given(), case.expect());
    use_parameters(&given)?;
    let mut named: Vec<(&[&str], Value)> = Vec::new();
    // The grid may be described also where only the states of its cells are asked for.
    for name in ["width", "height", "size_x", "size_y", "resolution", "origin_x", "origin_y"] {
        given.find(name).map_or(Ok(0.0), |it| it.number())?;
    }
    let values = given.find_any(&["data", "values", "occupancy"]);
    let points = given.find_any(&["points", "world"]);
    if let Some(values) = &values {
        // -1 may be written as 255.
        let state =
            |it: &CaseReader<'_>| Ok(CellState::from_occupancy(it.integer()? as i8).amcl_value());
        let names: &[&str] = match points {
            Some(_) => &["states", "occ_state"],
            None => &["states", "occ_state", "cells"],
        };
        named.push((names, json!(values.each(state)?)));
    }
    if let Some(points) = points {
        let size = |name: &str, other: &str| count(&given, name, count(&given, other, 100)?);
        let (width, height) = (size("width", "size_x")?, size("height", "size_y")?);
        let [x_m, y_m] = match given.find("origin") {
            Some(origin) => match *origin.numbers()?.as_slice() {
                [x_m, y_m, ..] => [x_m, y_m],
                _ => return Err(origin.unreadable("two numbers")),
            },
            None => [usual(&given, "origin_x", 0.0)?, usual(&given, "origin_y", 0.0)?],
        };
        let resolution_m = given.get("resolution")?.number()?;
        let info = GridInfo::new(resolution_m, width, height, Pose2::new(x_m, y_m, 0.0))
            .map_err(|error| Unreadable(error.to_string()))?;
        let settings = Settings { compat: AmclCompat::Nav2, ..Settings::default() }.map_settings();
        debug_assert_eq!(settings.alignment, CellAlignment::Centered);
        let map = LikelihoodMap::new(&Grid::new(info, 100), settings)
            .map_err(|error| Unreadable(error.message))?;
        let got =
            points.each(|point| point.array::<2>().map(|[x_m, y_m]| map.cell_at(x_m, y_m)))?;
        named.push((&["cells", "map", "indices"], json!(got)));
    }
    differences.compare_members(&named, &expect);
    Ok(())
}

/// The text of a saved pose, and what is read from it.
pub(super) fn check_pose_file(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Checked {
    let (given, expect) = (case.given(), case.expect());
    let number = |name: &str| given.get(name)?.number();
    let stamp = given.get("stamp")?.each(CaseReader::integer)?;
    let [seconds, nanoseconds] = stamp[..] else {
        return Err(given.get("stamp")?.unreadable("seconds and nanoseconds"));
    };
    let saved = SavedPose {
        time_ns: seconds.saturating_mul(1_000_000_000).saturating_add(nanoseconds),
        frame: given.get("frame")?.text()?.to_owned(),
        pose: Pose2::new(number("x")?, number("y")?, number("yaw")?),
        z_m: given.find("z").map_or(Ok(0.0), |it| it.number())?,
    };
    let text = saved.to_text();
    differences.compare_members(&[(&["text"], json!(text))], &expect);
    match SavedPose::parse(&text) {
        Ok(read) if read.to_text() == text => {}
        Ok(read) => differences.push(format!("read again it is {:?}", read.to_text())),
        Err(error) => differences.push(error.to_string()),
    }
    Ok(())
}
