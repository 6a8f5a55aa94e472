//! Options of `periplus bag`.

use std::path::PathBuf;

use crate::run_options::LiveNetworkOptions;
use clap::{Args, Subcommand, ValueEnum};
use periplus_bags::Style;
use periplus_bags::files::{ChunkPacking, Packing, PackingMode, Storage};

/// Record, play, convert, cut, check and repair bags
///
/// A recording is a folder of `ros2 bag` (MCAP or sqlite3, split, compressed, with or without
/// metadata.yaml), a single .mcap or .db3 file, or a .bag file of ROS 1, complete or truncated.
#[derive(Debug, Subcommand)]
pub(crate) enum BagCommand {
    Info(InfoOptions),
    Convert(ConvertOptions),
    Cut(CutOptions),
    Check(CheckOptions),
    Play(PlayOptions),
    Record(Box<RecordOptions>),
    Reindex(ReindexOptions),
}

/// Show the contents of recordings, as `ros2 bag info` does
#[derive(Debug, Args)]
pub(crate) struct InfoOptions {
    /// Recordings
    #[arg(required = true, value_name = "BAG")]
    pub(crate) bags: Vec<PathBuf>,
    /// Print only the names of the topics
    #[arg(long, short)]
    pub(crate) topic_name: bool,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Convert and merge recordings, between ROS 1 and ROS 2 and all their file formats
///
/// The extension of the output selects the format: .mcap, .db3, .bag, or a folder of `ros2 bag`.
/// Messages stay in the order of their times. Messages are translated between ROS 1 and ROS 2;
/// those that cannot be translated are omitted and reported.
#[derive(Debug, Args)]
pub(crate) struct ConvertOptions {
    /// Recordings
    #[arg(value_name = "BAG", required_unless_present = "input")]
    pub(crate) bags: Vec<PathBuf>,
    /// Input recording, as for `ros2 bag convert`; repeatable
    #[arg(long, short, value_name = "BAG")]
    pub(crate) input: Vec<PathBuf>,
    /// Output file or folder; or a YAML file with `output_bags`, as for `ros2 bag convert`, with
    /// one or several outputs
    #[arg(long, short, visible_alias = "output-options", value_name = "FILE|FOLDER|YAML")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) select: SelectOptions,
    #[command(flatten)]
    pub(crate) write: WriteOptions,
}

/// Copy a part of a recording: an interval, or some topics
#[derive(Debug, Args)]
pub(crate) struct CutOptions {
    /// Recording
    #[arg(value_name = "BAG")]
    pub(crate) bag: PathBuf,
    /// Output file or folder
    #[arg(long, short, value_name = "FILE|FOLDER")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) select: SelectOptions,
    #[command(flatten)]
    pub(crate) write: WriteOptions,
}

/// Read every byte and decode every message; exit code 1 on any error
#[derive(Debug, Args)]
pub(crate) struct CheckOptions {
    /// Recordings
    #[arg(required = true, value_name = "BAG")]
    pub(crate) bags: Vec<PathBuf>,
    /// Print findings as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Play a recording of ROS 1 or ROS 2 on ROS 2
#[derive(Debug, Args)]
pub(crate) struct PlayOptions {
    /// Recording
    #[arg(value_name = "BAG")]
    pub(crate) bag: PathBuf,
    /// Playback rate: seconds of the recording per second
    #[arg(long, short, default_value_t = 1.0, value_name = "FACTOR")]
    pub(crate) rate: f64,
    /// Restart at the end
    #[arg(long = "loop", short)]
    pub(crate) is_looped: bool,
    #[command(flatten)]
    pub(crate) names: NameOptions,
    /// Start this many seconds after the beginning
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) start_offset: Option<i64>,
    /// Duration to play, in seconds of the recording
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) playback_duration: Option<i64>,
    /// End of playback, in seconds of the recording
    #[arg(long, value_name = "SECONDS", value_parser = seconds, conflicts_with = "playback_duration")]
    pub(crate) playback_until_sec: Option<i64>,
    /// Remap topics: `from:=to`
    #[arg(long, short = 'm', num_args = 1.., value_name = "FROM:=TO")]
    pub(crate) remap: Vec<String>,
    /// Publish the time of the recording on /clock, at this rate [Hz]
    #[arg(long, num_args = 0..=1, default_missing_value = "40", value_name = "HZ")]
    pub(crate) clock: Option<f64>,
    /// Number of messages that are read ahead
    #[arg(long, default_value_t = 1000, value_name = "NUMBER")]
    pub(crate) read_ahead_queue_size: usize,
    /// Start paused; the ENTER key resumes and pauses
    #[arg(long, short = 'p')]
    pub(crate) start_paused: bool,
    /// Delay before the start [s]
    #[arg(long, short, default_value = "0", value_name = "SECONDS", value_parser = seconds)]
    pub(crate) delay: i64,
    #[command(flatten)]
    pub(crate) network: LiveNetworkOptions,
}

/// Record topics of ROS 2
///
/// Data is flushed every second. Ctrl-C ends the recording.
#[derive(Debug, Args)]
pub(crate) struct RecordOptions {
    /// Topics to record
    #[arg(value_name = "TOPIC")]
    pub(crate) topics: Vec<String>,
    /// Record all topics
    #[arg(long, short)]
    pub(crate) all: bool,
    /// Record topics that match this regular expression
    #[arg(long, short = 'e', value_name = "REGEX")]
    pub(crate) regex: Option<regex::Regex>,
    /// Exclude names that match this regular expression
    #[arg(long, short = 'x', visible_alias = "exclude-regex", value_name = "REGEX")]
    pub(crate) exclude: Option<regex::Regex>,
    /// Exclude these topics
    #[arg(long, num_args = 1.., value_name = "TOPIC")]
    pub(crate) exclude_topics: Vec<String>,
    /// Include topics whose names begin with an underscore
    #[arg(long)]
    pub(crate) include_hidden_topics: bool,
    /// Output file or folder [default: named by the time]
    #[arg(long, short, value_name = "FILE|FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// Use simulated time (/clock)
    #[arg(long)]
    pub(crate) use_sim_time: bool,
    #[command(flatten)]
    pub(crate) write: WriteOptions,
    #[command(flatten)]
    pub(crate) network: LiveNetworkOptions,
}

/// Rewrite the metadata.yaml of a folder from its files
#[derive(Debug, Args)]
pub(crate) struct ReindexOptions {
    /// Folder
    #[arg(value_name = "FOLDER")]
    pub(crate) bag: PathBuf,
    /// Format of the metadata
    #[arg(long, value_enum, default_value_t = Readers::Jazzy)]
    pub(crate) style: Readers,
}

/// Selection of topics.
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct NameOptions {
    /// Include only these topics
    #[arg(long, num_args = 1.., value_name = "TOPIC")]
    pub(crate) topics: Vec<String>,
    /// Include only topics that match this regular expression
    #[arg(long, short = 'e', value_name = "REGEX")]
    pub(crate) regex: Option<regex::Regex>,
    /// Exclude these topics
    #[arg(long, num_args = 1.., value_name = "TOPIC")]
    pub(crate) exclude_topics: Vec<String>,
    /// Exclude topics that match this regular expression
    #[arg(long, short = 'x', value_name = "REGEX")]
    pub(crate) exclude_regex: Option<regex::Regex>,
}

/// Selection of messages.
#[derive(Debug, Default, Args)]
pub(crate) struct SelectOptions {
    #[command(flatten)]
    pub(crate) names: NameOptions,
    /// Start this many seconds after the beginning
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) start_offset: Option<i64>,
    /// Duration of the part [s]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) duration: Option<i64>,
    /// Start time, in seconds since 1970 or of the simulation
    #[arg(long, value_name = "SECONDS", value_parser = seconds, conflicts_with = "start_offset")]
    pub(crate) start: Option<i64>,
    /// End time, in seconds since 1970 or of the simulation
    #[arg(long, value_name = "SECONDS", value_parser = seconds, conflicts_with = "duration")]
    pub(crate) end: Option<i64>,
}

/// Storage of the output.
#[derive(Debug, Default, Args)]
pub(crate) struct WriteOptions {
    /// Storage format, if the extension does not define it
    #[arg(long, short, value_enum)]
    pub(crate) storage: Option<StorageId>,
    /// Compression of chunks: none, lz4 or zstd for MCAP; none, lz4 or bz2 for ROS 1
    #[arg(long, value_enum)]
    pub(crate) chunks: Option<Chunks>,
    /// Compress whole files or each message
    #[arg(long, value_enum, default_value_t = Mode::None)]
    pub(crate) compression_mode: Mode,
    /// Compression of files or messages
    #[arg(long, value_enum, default_value_t = Format::Zstd)]
    pub(crate) compression_format: Format,
    /// Maximum size of a file [bytes]
    #[arg(long, short = 'b', value_name = "BYTES")]
    pub(crate) max_bag_size: Option<u64>,
    /// Maximum duration of a file [s]
    #[arg(long, short = 'd', value_name = "SECONDS", value_parser = seconds)]
    pub(crate) max_bag_duration: Option<i64>,
    /// Format of the metadata
    #[arg(long, value_enum, default_value_t = Readers::Jazzy)]
    pub(crate) style: Readers,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum StorageId {
    /// MCAP
    Mcap,
    /// sqlite3, the default until ROS 2 Humble
    Sqlite3,
    /// ROS 1 bag
    Rosbag,
}

impl From<StorageId> for Storage {
    fn from(id: StorageId) -> Self {
        match id {
            StorageId::Mcap => Self::Mcap,
            StorageId::Sqlite3 => Self::Sqlite,
            StorageId::Rosbag => Self::Ros1,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Chunks {
    None,
    Lz4,
    Zstd,
    Bz2,
}

impl From<Chunks> for ChunkPacking {
    fn from(chunks: Chunks) -> Self {
        match chunks {
            Chunks::None => Self::None,
            Chunks::Lz4 => Self::Lz4,
            Chunks::Zstd => Self::Zstd,
            Chunks::Bz2 => Self::Bz2,
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Mode {
    #[default]
    None,
    File,
    Message,
}

impl From<Mode> for PackingMode {
    fn from(mode: Mode) -> Self {
        match mode {
            Mode::None => Self::None,
            Mode::File => Self::File,
            Mode::Message => Self::Message,
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// The default of `ros2 bag`
    #[default]
    Zstd,
    /// LZ4; `ros2 bag` needs a plugin for it
    Lz4,
}

impl From<Format> for Packing {
    fn from(format: Format) -> Self {
        match format {
            Format::Zstd => Self::Zstd,
            Format::Lz4 => Self::Lz4,
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Readers {
    /// ROS 2 Humble and later
    Humble,
    /// ROS 2 Jazzy and later
    #[default]
    Jazzy,
}

impl From<Readers> for Style {
    fn from(readers: Readers) -> Self {
        match readers {
            Readers::Humble => Self::Humble,
            Readers::Jazzy => Self::Jazzy,
        }
    }
}

/// Parses seconds exactly \[ns\].
fn seconds(word: &str) -> Result<i64, String> {
    let wrong = || "give a number of seconds, such as 1.5".to_owned();
    let (whole, part) = word.split_once('.').unwrap_or((word, ""));
    let is_number = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    if whole.is_empty() && part.is_empty() || !is_number(whole) || !is_number(part) {
        return Err(wrong());
    }
    let whole: i64 = if whole.is_empty() { 0 } else { whole.parse().map_err(|_| wrong())? };
    let nano: i64 = format!("{part:0<9}")[..9].parse().map_err(|_| wrong())?;
    whole.checked_mul(1_000_000_000).and_then(|ns| ns.checked_add(nano)).ok_or_else(wrong)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_are_exact() {
        assert_eq!(seconds("1795273445.123456789"), Ok(1_795_273_445_123_456_789));
        assert_eq!(seconds(".5"), Ok(500_000_000));
        assert_eq!(seconds("7"), Ok(7_000_000_000));
        for wrong in ["", ".", "-1", "1e3", "99999999999", "1.x"] {
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
    }
}
