//! Report of a calibration.

use std::io::{self, Write};

use periplus_calibration::{DriveCalibration, Estimated, LidarNoise, RmsError};
use periplus_geometry::Pose2;
use serde_json::{Value, json};

use super::robot::NominalRobot;

/// Results of a calibration beside the nominal values.
pub(super) struct Report {
    pub(super) nominal: NominalRobot,
    /// Nominal pose of the scanner.
    pub(super) base_from_scanner: Pose2,
    pub(super) found: DriveCalibration,
    pub(super) lidar: Option<LidarNoise>,
    pub(super) prediction: Option<Prediction>,
}

/// Errors of odometry in the second half of a drive.
pub(super) struct Prediction {
    /// As expected from the first half.
    pub(super) expected: RmsError,
    pub(super) measured: RmsError,
}

/// A value beside its nominal one.
struct Row {
    name: &'static str,
    unit: &'static str,
    found: Estimated,
    nominal: Option<f64>,
}

impl Report {
    fn rows(&self) -> Vec<Row> {
        let found = &self.found;
        // The scanner is reported in the base frame.
        let base_from_scanner = self.nominal.base_from_axle * found.base_from_scanner();
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
        let rms = |it: &RmsError| json!({ "rms_m": it.rms_m, "rms_rad": it.rms_rad });
        let prediction = self
            .prediction
            .as_ref()
            .map(|it| json!({ "predicted": rms(&it.expected), "measured": rms(&it.measured) }));
        json!({
            "left_joint": self.nominal.left_joint,
            "right_joint": self.nominal.right_joint,
            "values": values,
            "displacements": self.found.residuals.len(),
            "rejected": self.found.rejected_count,
            "second_half": prediction,
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
        match &self.prediction {
            Some(Prediction { expected, measured }) => writeln!(
                out,
                "odometry errors of the second half: {:.4} m and {:.4} rad, predicted from the first: {:.4} m and \
                 {:.4} rad",
                measured.rms_m, measured.rms_rad, expected.rms_m, expected.rms_rad
            )?,
            None => writeln!(out, "the first half alone does not determine all values")?,
        }
        out.flush()
    }
}
