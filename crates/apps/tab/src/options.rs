//! Options of a tab, as JSON.

use std::path::PathBuf;

use serde::Deserialize;

/// Session of a tab.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct TabOptions {
    /// The demo; the only session so far.
    pub demo: DemoOptions,
}

/// Options of the demo, as those of `periplus demo`.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DemoOptions {
    /// Seed of all noise.
    pub seed: u64,
    /// True to explore autonomously.
    pub explore: bool,
    /// True to run the servers of navigation, which drive to goals of the user; not together with `explore`.
    pub navigation: bool,
    /// True without the page and its topics.
    pub headless: bool,
    /// True if the caller steps in real time: maps are then computed in slices, without pauses.
    pub is_paced: bool,
    /// Duration of the run \[s\]; images are taken shortly before its end.
    pub duration_s: Option<f64>,
    /// Folder of map, bag and images, in memory; none are made without it.
    pub out: Option<PathBuf>,
}
