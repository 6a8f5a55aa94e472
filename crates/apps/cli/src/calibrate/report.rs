//! Report of a calibration.

use std::io::{self, Write};

use periplus_calibration::{
    DriveCalibration, Estimated, ImuCalibration, ImuNoise, LidarNoise, PredictionError,
    RelativeError, SecondHalf,
};
use periplus_geometry::Pose2;
use serde_json::{Value, json};

use super::edit::{Outcome, OutcomeKind};
use super::robot::NominalRobot;

/// Results of a calibration beside the nominal values.
pub(super) struct Report {
    pub(super) nominal: NominalRobot,
    /// Nominal pose of the scanner.
    pub(super) base_from_scanner: Pose2,
    pub(super) found: DriveCalibration,
    pub(super) lidar: Option<LidarNoise>,
    pub(super) range_bias: Option<Estimated>,
    pub(super) imu: Option<ImuCalibration>,
    pub(super) second_half: Result<SecondHalf, PredictionError>,
    /// Numbers of the robot's texts, and what has none.
    pub(super) outcomes: Vec<Outcome>,
    pub(super) missing: Vec<String>,
}

/// A value beside its nominal one.
struct Row {
    name: String,
    unit: &'static str,
    found: Estimated,
    nominal: Option<f64>,
}

/// Rows of one axis of an IMU.
fn imu_rows(axis: &str, noise: &ImuNoise, units: [&'static str; 4]) -> Vec<Row> {
    let values = [
        ("bias", Some(noise.bias)),
        ("noise_density", Some(noise.noise_density)),
        ("bias_instability", noise.bias_instability),
        ("random_walk", noise.random_walk),
    ];
    let row = |((name, found), unit): ((&str, Option<Estimated>), &'static str)| {
        Some(Row { name: format!("{axis}_{name}"), unit, found: found?, nominal: None })
    };
    values.into_iter().zip(units).filter_map(row).collect()
}

impl Report {
    /// Calibrated pose of the scanner in the base frame.
    pub(super) fn base_from_found_scanner(&self) -> Pose2 {
        self.nominal.base_from_axle * self.found.base_from_scanner()
    }

    fn rows(&self) -> Vec<Row> {
        let found = &self.found;
        let base_from_scanner = self.base_from_found_scanner();
        let at = |value: f64, it: Estimated| Estimated { value, ..it };
        let row =
            |name: &str, unit, found, nominal| Row { name: name.to_owned(), unit, found, nominal };
        let drive = self.nominal.drive;
        let nominal = self.base_from_scanner;
        let mut rows = vec![
            row("left_wheel_radius", "m", found.left_radius_m, Some(drive.left_radius_m)),
            row("right_wheel_radius", "m", found.right_radius_m, Some(drive.right_radius_m)),
            row("wheel_distance", "m", found.wheel_distance_m, Some(drive.wheel_distance_m)),
            row("scanner_x", "m", at(base_from_scanner.x_m, found.scanner_x_m), Some(nominal.x_m)),
            row("scanner_y", "m", at(base_from_scanner.y_m, found.scanner_y_m), Some(nominal.y_m)),
            row("scanner_yaw", "rad", found.scanner_yaw_rad, Some(nominal.yaw_rad)),
            row("scan_delay", "s", found.delay_s, None),
        ];
        if let Some(lidar) = &self.lidar {
            rows.push(row("range_noise_std", "m", lidar.std_m, None));
            rows.push(row("range_dropout_ratio", "", lidar.dropout_ratio, None));
        }
        rows.extend(self.range_bias.map(|it| row("range_bias", "m", it, None)));
        if let Some(imu) = &self.imu {
            rows.extend(imu.delay_s.map(|it| row("imu_delay", "s", it, None)));
            rows.extend(imu.scale_ratio.map(|it| row("gyro_z_scale", "", it, None)));
            let kinds = [
                ("gyro", imu.gyroscope, ["rad/s", "rad/s^0.5", "rad/s", "rad/s^1.5"]),
                ("acc", imu.accelerometer, ["m/s^2", "m/s^1.5", "m/s^2", "m/s^2.5"]),
            ];
            for (kind, noises, units) in kinds {
                for (axis, noise) in ["x", "y", "z"].into_iter().zip(noises.iter().flatten()) {
                    rows.extend(imu_rows(&format!("{kind}_{axis}"), noise, units));
                }
            }
        }
        rows
    }

    /// JSON report.
    pub(super) fn to_json(&self) -> Value {
        let values: serde_json::Map<String, Value> = self
            .rows()
            .into_iter()
            .map(|it| {
                let value = json!({
                    "value": it.found.value, "standard_error": it.found.standard_error,
                    "unit": it.unit, "nominal": it.nominal,
                });
                (it.name, value)
            })
            .collect();
        let number =
            |it: Estimated| json!({ "value": it.value, "standard_error": it.standard_error });
        let error = |it: &RelativeError| {
            json!({
                "length_m": it.length_m,
                "trimmed_rms_m": number(it.trimmed_rms_m),
                "trimmed_rms_rad": number(it.trimmed_rms_rad),
                "rms_m": number(it.rms_m),
                "rms_rad": number(it.rms_rad),
            })
        };
        let prediction = match &self.second_half {
            Ok(half) => json!({
                "predicted": half.predicted.iter().map(error).collect::<Vec<_>>(),
                "measured": half.measured.iter().map(error).collect::<Vec<_>>(),
                "error_model": half.model.coefficients,
            }),
            Err(why) => json!({ "missing": why.to_string() }),
        };
        let outcome = |it: &Outcome| {
            let (kind, note) = match &it.kind {
                OutcomeKind::Agrees => ("agrees", None),
                OutcomeKind::Edited(note) => ("edited", note.as_ref()),
                OutcomeKind::Manual(why) => ("not edited", Some(why)),
            };
            json!({
                "name": it.name, "location": it.location, "current": it.current, "value": it.value,
                "outcome": kind, "note": note,
            })
        };
        json!({
            "left_joint": self.nominal.left_joint,
            "right_joint": self.nominal.right_joint,
            "values": values,
            "displacements": self.found.residuals.len(),
            "rejected": self.found.rejected_count,
            "second_half": prediction,
            "file": self.outcomes.iter().map(outcome).collect::<Vec<_>>(),
            "not_in_file": self.missing,
            "not_observable": self.imu.iter().flat_map(|it| &it.missing).collect::<Vec<_>>(),
        })
    }

    /// Prints the report as text.
    pub(super) fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{:<32}  {:>10}  {:>10}  {:>10}", "", "value", "± error", "nominal")?;
        for Row { name, unit, found, nominal } in self.rows() {
            let name = if unit.is_empty() { name } else { format!("{name} [{unit}]") };
            let nominal = nominal.map_or_else(|| "-".to_owned(), |it| format!("{it:.5}"));
            let (value, error) = (found.value, found.standard_error);
            writeln!(out, "{name:<32}  {value:>10.5}  {error:>10.5}  {nominal:>10}")?;
        }
        writeln!(
            out,
            "{} displacements of the scanner, {} rejected",
            self.found.residuals.len(),
            self.found.rejected_count
        )?;
        match &self.second_half {
            Ok(half) => {
                writeln!(
                    out,
                    "errors of odometry in the second half, without the largest 5 %, predicted from the first half:"
                )?;
                for (predicted, measured) in half.predicted.iter().zip(&half.measured) {
                    let (m, rad) = (predicted.trimmed_rms_m, predicted.trimmed_rms_rad);
                    writeln!(
                        out,
                        "  over {:>4} m: {:.4} m (predicted {:.4} ± {:.4}), {:.4} rad (predicted {:.4} ± {:.4})",
                        predicted.length_m,
                        measured.trimmed_rms_m.value,
                        m.value,
                        m.standard_error,
                        measured.trimmed_rms_rad.value,
                        rad.value,
                        rad.standard_error
                    )?;
                }
            }
            Err(why) => writeln!(out, "errors of odometry are not predicted: {why}")?,
        }
        if self.range_bias.is_none() {
            writeln!(
                out,
                "bias of the ranges: no flat walls are seen over more than 69 degrees, or they disagree"
            )?;
        }
        for why in self.imu.iter().flat_map(|it| &it.missing) {
            writeln!(out, "{why}")?;
        }
        self.print_outcomes(out)?;
        out.flush()
    }

    /// Prints what becomes of each number of the robot's texts.
    fn print_outcomes(&self, out: &mut dyn Write) -> io::Result<()> {
        for it in &self.outcomes {
            let Outcome { name, location, current, value, kind } = it;
            match kind {
                OutcomeKind::Agrees => {
                    writeln!(out, "{location}: {name} {current:.5} agrees")?;
                }
                OutcomeKind::Edited(note) => {
                    let note = note.as_ref().map_or_else(String::new, |it| format!(" ({it})"));
                    writeln!(out, "{location}: {name} {current:.5} -> {value:.5}{note}")?;
                }
                OutcomeKind::Manual(why) => {
                    writeln!(out, "{location}: {name} {current:.5} should be {value:.5}: {why}")?;
                }
            }
        }
        self.missing.iter().try_for_each(|it| writeln!(out, "{it}"))
    }
}
