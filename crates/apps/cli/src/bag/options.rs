//! What can be typed after `periplus bag`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use periplus_bagfiles::{ChunkPacking, Packing, PackingMode, Storage};
use periplus_bags::Style;

/// Recordings: look into them, play and record, convert, cut, check and mend them
///
/// A recording is a folder of `ros2 bag` (MCAP or sqlite3, split, packed, with or without its
/// metadata.yaml), a single .mcap or .db3, or a .bag of ROS 1, whole or cut.
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

/// Tell what recordings hold, as `ros2 bag info` does
#[derive(Debug, Args)]
pub(crate) struct InfoOptions {
    /// The recordings
    #[arg(required = true, value_name = "BAG")]
    pub(crate) bags: Vec<PathBuf>,
    /// Print only the names of the topics
    #[arg(long, short)]
    pub(crate) topic_name: bool,
    /// Print it as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Convert recordings, several into one, between ROS 1 and ROS 2 and all their kinds of files
///
/// The ending of the result says what it becomes: .mcap, .db3, .bag, or a folder as `ros2 bag`
/// makes it. Messages stay in the order of their times. What ROS 1 and ROS 2 hold differently is
/// translated; what cannot be is left out and named.
#[derive(Debug, Args)]
pub(crate) struct ConvertOptions {
    /// The recordings
    #[arg(value_name = "BAG", required_unless_present = "input")]
    pub(crate) bags: Vec<PathBuf>,
    /// A recording, as `ros2 bag convert` has it; may be given several times
    #[arg(long, short, value_name = "BAG")]
    pub(crate) input: Vec<PathBuf>,
    /// The new file or folder; or a YAML file with `output_bags`, as `ros2 bag convert` reads it, which
    /// names one or many and says what each holds and how
    #[arg(long, short, visible_alias = "output-options", value_name = "FILE|FOLDER|YAML")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) select: SelectOptions,
    #[command(flatten)]
    pub(crate) write: WriteOptions,
}

/// Copy a part of a recording: some time, some topics
#[derive(Debug, Args)]
pub(crate) struct CutOptions {
    /// The recording
    #[arg(value_name = "BAG")]
    pub(crate) bag: PathBuf,
    /// The new file or folder
    #[arg(long, short, value_name = "FILE|FOLDER")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) select: SelectOptions,
    #[command(flatten)]
    pub(crate) write: WriteOptions,
}

/// Read every byte and decode every message; exit code 1 when anything is wrong
#[derive(Debug, Args)]
pub(crate) struct CheckOptions {
    /// The recordings
    #[arg(required = true, value_name = "BAG")]
    pub(crate) bags: Vec<PathBuf>,
    /// Print what is wrong as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Play a recording to ROS 2, also one of ROS 1
#[derive(Debug, Args)]
pub(crate) struct PlayOptions {
    /// The recording
    #[arg(value_name = "BAG")]
    pub(crate) bag: PathBuf,
    /// Seconds of the recording per second
    #[arg(long, short, default_value_t = 1.0, value_name = "FACTOR")]
    pub(crate) rate: f64,
    /// Begin again at the end
    #[arg(long = "loop", short)]
    pub(crate) is_looped: bool,
    #[command(flatten)]
    pub(crate) names: NameOptions,
    /// From so many seconds after the beginning
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) start_offset: Option<i64>,
    /// So many seconds of the recording
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) playback_duration: Option<i64>,
    /// Until this time of the recording, in seconds
    #[arg(long, value_name = "SECONDS", value_parser = seconds, conflicts_with = "playback_duration")]
    pub(crate) playback_until_sec: Option<i64>,
    /// Names of topics to change: `from:=to`
    #[arg(long, short = 'm', num_args = 1.., value_name = "FROM:=TO")]
    pub(crate) remap: Vec<String>,
    /// Tell the time of the recording on /clock, so often a second of it
    #[arg(long, num_args = 0..=1, default_missing_value = "40", value_name = "HZ")]
    pub(crate) clock: Option<f64>,
    /// So many messages are read ahead
    #[arg(long, default_value_t = 1000, value_name = "NUMBER")]
    pub(crate) read_ahead_queue_size: usize,
    /// Wait for the key ENTER, and stop and go on by it
    #[arg(long, short = 'p')]
    pub(crate) start_paused: bool,
    /// Wait so many seconds at first
    #[arg(long, short, default_value = "0", value_name = "SECONDS", value_parser = seconds)]
    pub(crate) delay: i64,
}

/// Record what is said on ROS 2
///
/// What is a second old is on the disk, however the program ends. Ctrl-C ends the recording.
#[derive(Debug, Args)]
pub(crate) struct RecordOptions {
    /// The topics to record
    #[arg(value_name = "TOPIC")]
    pub(crate) topics: Vec<String>,
    /// Record all topics
    #[arg(long, short)]
    pub(crate) all: bool,
    /// Record topics that match this regular expression
    #[arg(long, short = 'e', value_name = "REGEX")]
    pub(crate) regex: Option<regex::Regex>,
    /// Not those that match this regular expression
    #[arg(long, short = 'x', visible_alias = "exclude-regex", value_name = "REGEX")]
    pub(crate) exclude: Option<regex::Regex>,
    /// Not these topics
    #[arg(long, num_args = 1.., value_name = "TOPIC")]
    pub(crate) exclude_topics: Vec<String>,
    /// Topics too whose names begin with an underscore
    #[arg(long)]
    pub(crate) include_hidden_topics: bool,
    /// The new file or folder; named by the time if not given
    #[arg(long, short, value_name = "FILE|FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// The times are those of /clock
    #[arg(long)]
    pub(crate) use_sim_time: bool,
    #[command(flatten)]
    pub(crate) write: WriteOptions,
}

/// Write the metadata.yaml of a folder anew, from what is in its files
#[derive(Debug, Args)]
pub(crate) struct ReindexOptions {
    /// The folder
    #[arg(value_name = "FOLDER")]
    pub(crate) bag: PathBuf,
    /// For which readers
    #[arg(long, value_enum, default_value_t = Readers::Jazzy)]
    pub(crate) style: Readers,
}

/// Which topics.
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct NameOptions {
    /// Only these topics
    #[arg(long, num_args = 1.., value_name = "TOPIC")]
    pub(crate) topics: Vec<String>,
    /// Only topics that match this regular expression
    #[arg(long, short = 'e', value_name = "REGEX")]
    pub(crate) regex: Option<regex::Regex>,
    /// Not these topics
    #[arg(long, num_args = 1.., value_name = "TOPIC")]
    pub(crate) exclude_topics: Vec<String>,
    /// No topics that match this regular expression
    #[arg(long, short = 'x', value_name = "REGEX")]
    pub(crate) exclude_regex: Option<regex::Regex>,
}

/// Which messages.
#[derive(Debug, Default, Args)]
pub(crate) struct SelectOptions {
    #[command(flatten)]
    pub(crate) names: NameOptions,
    /// From so many seconds after the beginning
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) start_offset: Option<i64>,
    /// So many seconds from there
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) duration: Option<i64>,
    /// From this time, in seconds since 1970 or of the simulation
    #[arg(long, value_name = "SECONDS", value_parser = seconds, conflicts_with = "start_offset")]
    pub(crate) start: Option<i64>,
    /// Until this time, in seconds since 1970 or of the simulation
    #[arg(long, value_name = "SECONDS", value_parser = seconds, conflicts_with = "duration")]
    pub(crate) end: Option<i64>,
}

/// How recordings are written.
#[derive(Debug, Default, Args)]
pub(crate) struct WriteOptions {
    /// How files are stored, where the ending does not say it
    #[arg(long, short, value_enum)]
    pub(crate) storage: Option<StorageId>,
    /// How the chunks inside of files are packed: MCAP has none, lz4, zstd, ROS 1 none, lz4, bz2
    #[arg(long, value_enum)]
    pub(crate) chunks: Option<Chunks>,
    /// Pack whole files or every message besides
    #[arg(long, value_enum, default_value_t = Mode::None)]
    pub(crate) compression_mode: Mode,
    /// How files or messages are packed
    #[arg(long, value_enum, default_value_t = Format::Zstd)]
    pub(crate) compression_format: Format,
    /// A new file begins when one has so many bytes
    #[arg(long, short = 'b', value_name = "BYTES")]
    pub(crate) max_bag_size: Option<u64>,
    /// A new file begins when one spans so many seconds
    #[arg(long, short = 'd', value_name = "SECONDS", value_parser = seconds)]
    pub(crate) max_bag_duration: Option<i64>,
    /// For which readers the metadata is written
    #[arg(long, value_enum, default_value_t = Readers::Jazzy)]
    pub(crate) style: Readers,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum StorageId {
    /// MCAP
    Mcap,
    /// A database, the usual one until ROS 2 Humble
    Sqlite3,
    /// A bag of ROS 1
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
    /// The one that `ros2 bag` comes with
    #[default]
    Zstd,
    /// For `ros2 bag` with a plugin
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

/// Seconds, exactly \[ns\].
fn seconds(word: &str) -> Result<i64, String> {
    let wrong = || "it has to be a number of seconds, such as 1.5".to_owned();
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
