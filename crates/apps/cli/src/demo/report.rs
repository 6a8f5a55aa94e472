//! JSON report of the demo.

use periplus_geometry::Pose2;
use periplus_maps::BesideTruth;
use periplus_session::RunReport;
use periplus_session::demo::ExplorerNode;
use periplus_session::nodes::MappingNode;
use serde_json::{Value, json};

/// Report of the run with map quality and pose error. The robot starts at the origin of the world,
/// which is also the origin of the map, so that estimate and ground truth can be compared.
pub(super) fn of(
    run: &RunReport<'_>,
    mapping: &MappingNode,
    truth: Option<&BesideTruth>,
    explorer: Option<&ExplorerNode>,
) -> Value {
    let mut report = run.to_json();
    let status = mapping.node.with(|node| node.status());
    if let Some(map) = mapping.node.with(|node| node.map()) {
        let cell_m2 = map.info.resolution_m * map.info.resolution_m;
        let area_m2 = |wanted: fn(&i8) -> bool| {
            map.cells.iter().filter(|value| wanted(value)).count() as f64 * cell_m2
        };
        report["map"] = json!({
            "cells": [map.info.width, map.info.height],
            "resolution_m": map.info.resolution_m,
            "free_m2": area_m2(|value| (0..=25).contains(value)),
            "occupied_m2": area_m2(|value| *value >= 65),
            "scans": status.counts.scans,
            "kept": status.counts.kept,
        });
    }
    if let Some(truth) = truth {
        let numbers = truth.numbers().into_iter();
        let numbers = numbers.map(|(name, value)| (name.to_owned(), json!(value)));
        report["truth"] = Value::Object(numbers.collect());
    }
    let truth = run.simulation.robot_pose().map(Pose2::from);
    if let (Some(explorer), Some(truth)) = (explorer, truth) {
        let error_m = explorer
            .map_from_base
            .map(|pose| libm::hypot(pose.x_m - truth.x_m, pose.y_m - truth.y_m));
        report["exploration"] = json!({
            "state": format!("{:?}", explorer.mood()).to_lowercase(),
            "driven_m": explorer.driven_m,
            "pose_error_m": error_m,
        });
    }
    report
}
