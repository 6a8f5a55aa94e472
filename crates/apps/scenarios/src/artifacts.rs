//! Artifacts of a run: recording, map, picture, log, report, and the command that runs it again.

use std::fs;
use std::path::{Path, PathBuf};

use periplus_geometry::Pose2;
use periplus_maps::{Distro, Saving, render};
use periplus_os::shell_word;
use periplus_session::{RecordingRequest, SimulationSession, files, picture};

use crate::error::ScenarioError;
use crate::file::Scenario;
use crate::report::ScenarioReport;
use crate::run::{RunRecord, ScenarioRunOptions};

/// Name of the recording.
const BAG_FILE: &str = "run.mcap";

/// Every Nth pose of the trajectory is drawn.
const DRAWN_POSE_STEP: usize = 5;

/// Folder of the artifacts of a run.
pub(crate) struct Artifacts {
    folder: PathBuf,
    is_new: bool,
}

impl Artifacts {
    /// Creates the folder.
    pub(crate) fn begin(folder: &Path) -> Result<Self, ScenarioError> {
        let is_new = !folder.exists();
        files::make_folder(folder)?;
        Ok(Self { folder: folder.to_owned(), is_new })
    }

    /// Starts the recording: all topics but images and point clouds.
    pub(crate) fn record(&self, session: &mut SimulationSession) -> Result<(), ScenarioError> {
        let heavy: Vec<String> = session
            .graph()
            .topics()
            .into_iter()
            .filter(|topic| !crate::run::is_light(&topic.type_name))
            .map(|topic| topic.name)
            .collect();
        let wanted = Box::new(move |name: &str| heavy.iter().all(|heavy| heavy != name));
        session.start_recording(RecordingRequest::new(self.folder.join(BAG_FILE), wanted))?;
        Ok(())
    }

    /// Writes the artifacts, or removes the recording if they are not kept.
    pub(crate) fn finish(
        self,
        keeps: bool,
        scenario: &Scenario,
        session: &mut SimulationSession,
        record: &RunRecord,
        report: &mut ScenarioReport,
    ) -> Result<(), ScenarioError> {
        if !keeps {
            // Nothing depends on whether the recording can be removed.
            let _ = fs::remove_file(self.folder.join(BAG_FILE));
            if self.is_new {
                let _ = fs::remove_dir(&self.folder);
            }
            return Ok(());
        }
        report.artifacts = Some(self.folder.clone());
        let put = |name: &str, bytes: &[u8]| files::write(&self.folder.join(name), bytes);
        if let Some(map) = &record.slam_map {
            let files = render(map, &Saving::new("map", Distro::Jazzy));
            put(&files.image_path, &files.image)?;
            put(&files.yaml_path, files.yaml.as_bytes())?;
        }
        if let Some(grid) = record.grid
            && let Some(truth) = session.simulation_mut().truth_map(grid)
        {
            let poses = record.truth.trajectory.poses().iter().step_by(DRAWN_POSE_STEP);
            let trajectory: Vec<Pose2> = poses.map(|it| Pose2::from(it.pose)).collect();
            let goals: Vec<(f64, f64)> =
                report.goals.iter().map(|end| (end.goal.x_m, end.goal.y_m)).collect();
            put("run.png", &picture::draw(&truth, &trajectory, &goals))?;
        }
        put("log.txt", (record.log.join("\n") + "\n").as_bytes())?;
        put("scenario.yaml", scenario.text().as_bytes())?;
        put("replay.txt", format!("{}\n", report.replay).as_bytes())?;
        put("report.json", format!("{:#}\n", report.to_json()).as_bytes())?;
        Ok(())
    }
}

/// Command that runs a scenario again with the same seed and variables.
pub(crate) fn replay_command(
    scenario: &Scenario,
    options: &ScenarioRunOptions,
    seed: u64,
) -> String {
    let mut words =
        vec!["periplus scenario".to_owned(), shell_word(&scenario.path.display().to_string())];
    words.push(format!("--seed {seed}"));
    for (name, value) in &options.set {
        words.push(format!("--set {}", shell_word(&format!("{name}={value}"))));
    }
    for [node, name, value] in &options.parameters {
        let node = node.trim_start_matches('/');
        words.push(format!("--parameter {}", shell_word(&format!("{node}:{name}={value}"))));
    }
    words.push("--keep".to_owned());
    words.join(" ")
}

impl Scenario {
    /// Text of the file.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }
}
