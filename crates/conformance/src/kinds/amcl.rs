//! Localization by particles: models, sample sizes, recovery, the saved pose.

use periplus_base::{Pose2, normalize_angle};
use periplus_grid::{Grid, Lattice};
use periplus_localization::{
    BIN_M, BIN_RAD, CellPlace, CellState, Compat, Glide, KnownMap, Mixture, Model, Recovery,
    SampleSize, SavedPose, Settings, TurnWayTurn, has_moved, weight_of_cubes, weight_of_product,
};

use super::Setting;
use crate::{Case, Differences, Reader, Unreadable};

type Checked = Result<(), Unreadable>;

/// A number, or what it is by default.
fn number(given: &Reader<'_>, name: &str, usual: f64) -> Result<f64, Unreadable> {
    given.find(name).map_or(Ok(usual), |it| it.number())
}

/// A whole number, or what it is by default.
fn count(given: &Reader<'_>, name: &str, usual: usize) -> Result<usize, Unreadable> {
    given.find(name).map_or(Ok(usual), |it| it.count())
}

fn mixture(given: &Reader<'_>) -> Result<Mixture, Unreadable> {
    let usual = Settings::default().mixture;
    Ok(Mixture {
        hit: number(given, "z_hit", usual.hit)?,
        short: number(given, "z_short", usual.short)?,
        max: number(given, "z_max", usual.max)?,
        random: number(given, "z_rand", usual.random)?,
        sigma_m: number(given, "sigma_hit", usual.sigma_m)?,
        lambda: number(given, "lambda_short", usual.lambda)?,
    })
}

fn pose(reader: &Reader<'_>) -> Result<Pose2, Unreadable> {
    let [x_m, y_m, yaw_rad] = reader.array()?;
    Ok(Pose2::new(x_m, y_m, yaw_rad))
}

/// Which model a case is about: it says so, or its name does.
fn model(case: &Case) -> Result<Model, Unreadable> {
    let given = case.given();
    let named = ["laser_model_type", "model"].iter().find_map(|name| given.find(name));
    let word = named.map_or(Ok(case.id.as_str()), |it| it.text())?;
    Ok(if word.contains("prob") { Model::LikelihoodFieldProb } else { Model::LikelihoodField })
}

/// Pairs of what a beam measured and what it should have.
pub(super) fn check_beam(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Checked {
    let (given, expect) = (case.given(), case.expect());
    let mixture = mixture(&given)?;
    let range_max_m = given.get("range_max")?.number()?;
    let pairs = given.get("pairs")?.each(Reader::array::<2>)?;
    let likelihoods: Vec<f64> =
        pairs.iter().map(|[measured, map]| mixture.beam(*measured, *map, range_max_m)).collect();
    if let Some(expected) = expect.find("p") {
        differences.all_near("p", &likelihoods, &expected.numbers()?);
    }
    if let Some(expected) = expect.find("weight") {
        differences.near("weight", weight_of_cubes(likelihoods), expected.number()?);
    }
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
    let mixture = mixture(&given)?;
    let range_max_m = given.get("range_max")?.number()?;
    let outside_m =
        number(&given, "laser_likelihood_max_dist", Settings::default().distance_max_m)?;
    let likelihoods = given.get("occ_dist")?.each(|distance| {
        let distance_m = if distance.is_null() { outside_m } else { distance.number()? };
        Ok(mixture.field(distance_m, range_max_m))
    })?;
    if let Some(expected) = expect.find("p") {
        differences.all_near("p", &likelihoods, &expected.numbers()?);
    }
    if let Some(expected) = expect.find("weight") {
        let weight = match model(case)? {
            Model::LikelihoodFieldProb => weight_of_product(likelihoods),
            Model::LikelihoodField | Model::Beam => weight_of_cubes(likelihoods),
        };
        differences.near("weight", weight, expected.number()?);
    }
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
    let names = ["range_count", "beams", "count", "n"];
    let total = match (names.iter().find_map(|name| given.find(name)), given.find("ranges")) {
        (Some(total), _) => total.count()?,
        (None, Some(ranges)) => ranges.list()?.len(),
        (None, None) => return Err(given.unreadable("an object with `range_count` or `ranges`")),
    };
    let most = count(&given, "max_beams", Settings::default().beams.most)?;
    let stride = model(case)?.thinning().stride(total, most);
    if let Some(expected) = ["step", "stride"].iter().find_map(|name| expect.find(name)) {
        differences.same("step", &stride, &expected.count()?);
    }
    let used: Vec<usize> = (0..total).step_by(stride).collect();
    if let Some(expected) = ["indices", "used"].iter().find_map(|name| expect.find(name)) {
        differences.same("beams used", &used, &expected.each(Reader::count)?);
    }
    if let Some(expected) = ["used_beams", "count"].iter().find_map(|name| expect.find(name)) {
        differences.same("how many are used", &used.len(), &expected.count()?);
    }
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
    let usual = Settings::default().size;
    let size = SampleSize {
        error: number(&given, "pf_err", usual.error)?,
        quantile: number(&given, "pf_z", usual.quantile)?,
        least: count(&given, "min_particles", usual.least)?,
        most: count(&given, "max_particles", usual.most)?,
    };
    let needed: Vec<usize> =
        given.get("k")?.each(Reader::count)?.into_iter().map(|bins| size.needed(bins)).collect();
    differences.same("samples", &needed, &expect.get("samples")?.each(Reader::count)?);
    if let Some(expected) = expect.find("bin_size") {
        differences.all_near("bin_size", &[BIN_M, BIN_M, BIN_RAD], &expected.numbers()?);
    }
    Ok(())
}

/// What motions are made of and how far they may be off.
pub(super) fn check_motion(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Checked {
    let given = case.given();
    let mut alphas = [0.0; 5];
    let written = given.get("alpha")?;
    for (alpha, value) in alphas.iter_mut().zip(written.numbers()?) {
        *alpha = value;
    }
    let (moves, results) = (given.get("moves")?.list()?, case.expect().get("result")?.list()?);
    differences.same("number of results", &results.len(), &moves.len());
    for (index, (motion, expected)) in moves.iter().zip(&results).enumerate() {
        let old = pose(&motion.get("old_pose")?)?;
        let delta = pose(&motion.get("delta")?)?;
        // In the frame of odometry, not in that of the robot.
        let new = Pose2::new(old.x_m + delta.x_m, old.y_m + delta.y_m, old.yaw_rad + delta.yaw_rad);
        let turns = TurnWayTurn::between(old, new);
        let (turns, turns_spread) = (turns, turns.spread(&alphas));
        let glide = Glide::between(old, new);
        let glide_spread = glide.spread(&alphas);
        let is_glide = ["sd_strafe", "sd_rot", "rot"].iter().any(|it| expected.find(it).is_some());
        for (name, value) in expected.members()? {
            let (got, is_angle) = match name {
                "rot1" => (turns.first_rad, true),
                "rot2" => (turns.second_rad, true),
                "trans" => (turns.way_m, false),
                "sd_rot1" => (turns_spread.first_rad, false),
                "sd_rot2" => (turns_spread.second_rad, false),
                "sd_trans" if is_glide => (glide_spread.way_m, false),
                "sd_trans" => (turns_spread.way_m, false),
                "sd_rot" => (glide_spread.turn_rad, false),
                "sd_strafe" => (glide_spread.strafe_m, false),
                "rot" => (glide.turn_rad, true),
                "bearing" => (glide.bearing_rad, true),
                _ => return Err(value.unreadable("a part of a motion that is known")),
            };
            let what = format!("move {index}: {name}");
            let expected = value.number()?;
            if is_angle {
                // Half a turn to the left is half a turn to the right.
                differences.near(what, expected + normalize_angle(got - expected), expected);
            } else {
                differences.near(what, got, expected);
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
    if let Some(means) = given.find("w_avg") {
        let alphas = [
            number(&given, "recovery_alpha_slow", 0.0)?,
            number(&given, "recovery_alpha_fast", 0.0)?,
        ];
        let mut recovery = Recovery::default();
        let mut lists = [Vec::new(), Vec::new(), Vec::new()];
        for mean in means.numbers()? {
            recovery.take(mean, alphas);
            let values = [recovery.slow, recovery.fast, recovery.share()];
            lists.iter_mut().zip(values).for_each(|(list, value)| list.push(value));
        }
        for (name, got) in ["w_slow", "w_fast", "w_diff"].iter().zip(&lists) {
            if let Some(expected) = expect.find(name) {
                differences.all_near(name, got, &expected.numbers()?);
            }
        }
    }
    let moves = ["moves", "deltas"].iter().find_map(|name| given.find(name));
    let updates = ["update", "updates", "result"].iter().find_map(|name| expect.find(name));
    if let (Some(moves), Some(expected)) = (moves, updates) {
        let usual = Settings::default().update_min;
        let least =
            (number(&given, "update_min_d", usual.0)?, number(&given, "update_min_a", usual.1)?);
        let got = moves.each(|delta| Ok(has_moved(Pose2::IDENTITY, pose(delta)?, least)))?;
        differences.same("updates", &got, &expected.each(Reader::truth)?);
    }
    Ok(())
}

/// What cells mean, and in which cell a point is for Nav2's AMCL.
pub(super) fn check_map(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Checked {
    let (given, expect) = (case.given(), case.expect());
    let values = ["data", "values", "occupancy"].iter().find_map(|name| given.find(name));
    let states = ["states", "occ_state", "cells"].iter().find_map(|name| expect.find(name));
    if let (Some(values), Some(states)) = (values, states) {
        // -1 may be written as 255.
        let value = |it: &Reader<'_>| Ok(it.integer()? as i8);
        let got: Vec<i64> =
            values.each(value)?.into_iter().map(|it| CellState::of(it).number().into()).collect();
        differences.same("states of cells", &got, &states.each(Reader::integer)?);
    }
    let points = ["points", "world"].iter().find_map(|name| given.find(name));
    let cells = ["cells", "map", "indices"].iter().find_map(|name| expect.find(name));
    if let (Some(points), Some(cells)) = (points, cells) {
        let size = |name: &str, other: &str| count(&given, name, count(&given, other, 100)?);
        let (width, height) = (size("width", "size_x")?, size("height", "size_y")?);
        let [x_m, y_m] = match given.find("origin") {
            Some(origin) => [0, 1].map(|at| origin.value()[at].as_f64().unwrap_or_default()),
            None => [number(&given, "origin_x", 0.0)?, number(&given, "origin_y", 0.0)?],
        };
        let resolution_m = given.get("resolution")?.number()?;
        let lattice = Lattice::new(resolution_m, width, height, Pose2::new(x_m, y_m, 0.0))
            .map_err(|error| Unreadable(error.to_string()))?;
        let settings = Settings { compat: Compat::Nav2, ..Settings::default() }.map();
        debug_assert_eq!(settings.place, CellPlace::Centred);
        let map = KnownMap::new(&Grid::new(lattice, 100), settings)
            .map_err(|error| Unreadable(error.message))?;
        let got =
            points.each(|point| point.array::<2>().map(|[x_m, y_m]| map.cell_at(x_m, y_m)))?;
        let expected =
            cells.each(|cell| cell.array::<2>().map(|it| (it[0] as i64, it[1] as i64)))?;
        differences.same("cells of points", &got, &expected);
    }
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
    let stamp = given.get("stamp")?.each(Reader::integer)?;
    let [seconds, nanoseconds] = stamp[..] else {
        return Err(given.get("stamp")?.unreadable("seconds and nanoseconds"));
    };
    let saved = SavedPose {
        time_ns: seconds.saturating_mul(1_000_000_000).saturating_add(nanoseconds),
        frame: given.get("frame")?.text()?.to_owned(),
        pose: Pose2::new(number("x")?, number("y")?, number("yaw")?),
        z_m: given.find("z").map_or(Ok(0.0), |it| it.number())?,
    };
    let text = expect.get("text")?.text()?;
    differences.same("text", saved.to_text().as_str(), text);
    match SavedPose::read(text) {
        Ok(read) => differences.same("text written again", read.to_text().as_str(), text),
        Err(error) => differences.push(error.to_string()),
    }
    Ok(())
}
