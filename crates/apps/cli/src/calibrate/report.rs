//! Report of a calibration.

use std::io::{self, Write};

use periplus_calibration::{
    DriveCalibration, Estimated, LidarNoise, PredictionError, RelativeError, SecondHalf,
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
    pub(super) second_half: Result<SecondHalf, PredictionError>,
    /// Numbers of the robot's texts, and what has none.
    pub(super) outcomes: Vec<Outcome>,
    pub(super) missing: Vec<String>,
}

/// A value beside its nominal one.
struct Row {
    name: &'static str,
    unit: &'static str,
    found: Estimated,
    nominal: Option<f64>,
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
        let row = |name, unit, found, nominal| Row { name, unit, found, nominal };
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
                (it.name.to_owned(), value)
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
        })
    }

    /// Prints the report as text.
    pub(super) fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{:<20}  {:>10}  {:>10}  {:>10}", "", "value", "± error", "nominal")?;
        for Row { name, unit, found, nominal } in self.rows() {
            let name = if unit.is_empty() { name.to_owned() } else { format!("{name} [{unit}]") };
            let nominal = nominal.map_or_else(|| "-".to_owned(), |it| format!("{it:.5}"));
            let (value, error) = (found.value, found.standard_error);
            writeln!(out, "{name:<20}  {value:>10.5}  {error:>10.5}  {nominal:>10}")?;
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
                    writeln!(out, "{location}: write {name} {value:.5} for {current:.5}: {why}")?;
                }
            }
        }
        self.missing.iter().try_for_each(|it| writeln!(out, "{it}"))
    }
}
