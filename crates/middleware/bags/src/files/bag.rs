//! Opening of bags.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::{BagTopic, Metadata, Selection, Style, read_metadata};
use periplus_diagnostics::{Diagnostic, Diagnostics, SourceMap};
use periplus_os::fs;

use crate::files::BagError;
use crate::files::indexed::{OpenProgress, convert_carmen, is_carmen_file};
use crate::files::naming::bag_files;
use crate::files::part::Part;
use crate::files::stream::BagMessages;
use crate::files::temporary::Temporary;
use crate::files::write::Storage;

/// ROS version of a bag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BagKind {
    /// A `ros2 bag` folder, or its files.
    Ros2,
    /// ROS 1 bags.
    Ros1,
}

/// A bag of one or more files.
#[derive(Debug)]
pub struct Bag {
    path: PathBuf,
    parts: Vec<Part>,
    topics: Vec<BagTopic>,
    counts: Vec<u64>,
    metadata: Option<Metadata>,
    findings: Diagnostics,
    /// Copy of a log of another format, removed with the bag.
    _copy: Option<Temporary>,
}

/// Name of the metadata file in a folder.
pub(crate) const METADATA: &str = "metadata.yaml";

/// Maximum size of `metadata.yaml` \[bytes\].
const LARGEST_METADATA: u64 = 64 << 20;

impl Bag {
    /// Opens a bag of any kind. Damaged or missing parts are reported in the
    /// [findings](Self::findings); the rest can be read.
    ///
    /// # Errors
    /// When there is no bag at the path.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, BagError> {
        Self::open_with(path.as_ref(), &mut Part::look)
    }

    /// Opens a bag of any kind, or a CARMEN log, which is read into a temporary file with messages of ROS 2: `/scan`, `/odom`
    /// and `/tf`.
    ///
    /// # Errors
    /// When there is no bag and no log at the path.
    pub fn open_log(path: impl AsRef<Path>) -> Result<Self, BagError> {
        let path = path.as_ref();
        if !is_carmen_file(path)? {
            return Self::open(path);
        }
        let (copy, faults) = convert_carmen(path, &OpenProgress::default())?;
        let mut bag = Self::open(copy.path())?;
        bag._copy = Some(copy);
        path.clone_into(&mut bag.path);
        for (line, fault) in faults {
            let wrong = format!("`{}`: line {line}: {fault}", path.display());
            bag.findings.push(Diagnostic::warning("damaged-log", wrong));
        }
        Ok(bag)
    }

    /// Opens a bag whose files are read by `look`.
    pub(crate) fn open_with(
        path: &Path,
        look: &mut dyn FnMut(&Path) -> Result<Part, BagError>,
    ) -> Result<Self, BagError> {
        let about = fs::metadata(path).map_err(BagError::file(path))?;
        let mut findings = Diagnostics::new();
        if !about.is_dir() && path.file_name().is_some_and(|name| name == METADATA) {
            let folder = path.parent().filter(|parent| !parent.as_os_str().is_empty());
            return Self::open_with(folder.unwrap_or(Path::new(".")), look);
        }
        let (files, metadata) = if about.is_dir() {
            folder_files(path, &mut findings)?
        } else {
            (vec![path.to_owned()], None)
        };
        let mut parts = Vec::new();
        let mut failure = None;
        for file in &files {
            match look(file) {
                Ok(part) => parts.push(part),
                Err(error) => {
                    let wrong = Diagnostic::error("unreadable-part", error.to_string());
                    findings.push(wrong.help("the other files are read without it"));
                    failure.get_or_insert(error);
                }
            }
        }
        if parts.is_empty() {
            let why = "the folder has no .mcap and no .db3 file".to_owned();
            return Err(failure.unwrap_or(BagError::NoBag(path.to_owned(), why)));
        }
        for part in &parts {
            for fault in &part.faults {
                let wrong = format!("`{}`: {fault}", part.path.display());
                findings.push(Diagnostic::warning("damaged-bag", wrong));
            }
        }
        let mut bag = Self {
            path: path.to_owned(),
            parts,
            topics: Vec::new(),
            counts: Vec::new(),
            metadata,
            findings,
            _copy: None,
        };
        bag.join_topics();
        Ok(bag)
    }

    fn join_topics(&mut self) {
        let mut index = TopicIndex::default();
        for part in &self.parts {
            for (topic, count) in part.topics.iter().zip(&part.counts) {
                let at = index.add(topic);
                if at == self.topics.len() {
                    self.topics.push(topic.clone());
                    self.counts.push(0);
                }
                self.counts[at] = self.counts[at].saturating_add(*count);
                if self.topics[at].schema.is_empty() {
                    self.topics[at].schema.clone_from(&topic.schema);
                    self.topics[at].schema_encoding.clone_from(&topic.schema_encoding);
                }
            }
        }
    }

    /// Path of the bag.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// ROS version of the bag.
    #[must_use]
    pub fn kind(&self) -> BagKind {
        let is_ros1 = self.parts.iter().any(|part| part.storage == Storage::Ros1);
        if is_ros1 { BagKind::Ros1 } else { BagKind::Ros2 }
    }

    /// Storage format of its files.
    #[must_use]
    pub fn storage(&self) -> Storage {
        self.parts.first().map_or(Storage::Mcap, |part| part.storage)
    }

    /// Topic index of each topic of each file.
    pub(crate) fn topics_of_parts(&self) -> Vec<Vec<usize>> {
        let index = TopicIndex::of(&self.topics);
        let of_part = |part: &Part| {
            part.topics.iter().map(|topic| index.find(topic).unwrap_or_default()).collect()
        };
        self.parts.iter().map(of_part).collect()
    }

    /// Topics.
    #[must_use]
    pub fn topics(&self) -> &[BagTopic] {
        &self.topics
    }

    /// Number of messages of each topic.
    #[must_use]
    pub fn counts(&self) -> &[u64] {
        &self.counts
    }

    /// Number of messages.
    #[must_use]
    pub fn message_count(&self) -> u64 {
        self.counts.iter().fold(0, |sum, count| u64::saturating_add(sum, *count))
    }

    /// Times of the first and last message \[ns\]; none without messages.
    #[must_use]
    pub fn span_ns(&self) -> Option<(i64, i64)> {
        let spans = self.parts.iter().filter_map(|part| part.span_ns);
        spans.reduce(|(start, end), (from, to)| (start.min(from), end.max(to)))
    }

    /// Size of the files \[bytes\].
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.parts.iter().map(|part| part.bytes).sum()
    }

    /// Paths of the files.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        self.parts.iter().map(|part| &*part.path)
    }

    /// Content of `metadata.yaml`, if it exists.
    #[must_use]
    pub fn metadata(&self) -> Option<&Metadata> {
        self.metadata.as_ref()
    }

    /// Name of the ROS distribution that recorded the bag; empty if unknown.
    #[must_use]
    pub fn ros_distro(&self) -> &str {
        let told = self.metadata.as_ref().map_or("", |metadata| &metadata.info.ros_distro);
        if !told.is_empty() {
            return told;
        }
        self.parts.iter().map(|part| &*part.ros_distro).find(|name| !name.is_empty()).unwrap_or("")
    }

    /// Facts that the recorder wrote by name, such as the command and the world of a simulation.
    #[must_use]
    pub fn custom_data(&self) -> &BTreeMap<String, String> {
        static NONE: BTreeMap<String, String> = BTreeMap::new();
        let of_folder = self.metadata.as_ref().map(|metadata| &metadata.info.custom_data);
        let of_parts = self.parts.iter().map(|part| &part.custom_data);
        of_folder.into_iter().chain(of_parts).find(|data| !data.is_empty()).unwrap_or(&NONE)
    }

    /// True if every file was closed properly.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.parts.iter().all(|part| part.is_whole)
    }

    /// Problems found.
    #[must_use]
    pub fn findings(&self) -> &Diagnostics {
        &self.findings
    }

    /// Iterates over the messages in the order of time across all files. Files are opened on demand
    /// and closed when they are read.
    #[must_use]
    pub fn messages(&self, selection: Selection) -> BagMessages {
        BagMessages::new(&self.parts, &self.topics, selection)
    }

    /// Metadata of its files.
    #[must_use]
    pub fn describe(&self) -> crate::BagInfo {
        let mut topics: Vec<_> =
            self.topics.iter().map(crate::files::profile::topic_info).collect();
        for (topic, count) in topics.iter_mut().zip(&self.counts) {
            topic.messages = *count;
        }
        let name =
            |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let file = |part: &Part| crate::FileInfo {
            path: name(&part.path),
            span_ns: part.span_ns,
            messages: part.counts.iter().sum(),
        };
        let files = self.parts.iter().map(file).collect();
        crate::BagInfo {
            topics,
            files,
            ros_distro: self.ros_distro().to_owned(),
            custom_data: self.custom_data().clone(),
        }
    }

    /// Rewrites `metadata.yaml` from the files.
    ///
    /// # Errors
    /// When the bag is not a `ros2 bag` folder, or the file cannot be written.
    pub fn reindex(&self, style: Style) -> Result<(), BagError> {
        if !fs::is_dir(&self.path) {
            let why = "only folders of `ros2 bag` have a metadata.yaml".to_owned();
            return Err(BagError::NoBag(self.path.clone(), why));
        }
        let packing = self.parts.iter().find_map(|part| part.packing);
        let told = |get: fn(&Metadata) -> &String| {
            self.metadata.as_ref().map(get).cloned().unwrap_or_default()
        };
        let stored = crate::Stored {
            storage: self.storage().identifier().into(),
            compression: packing.map_or_else(
                || told(|metadata| &metadata.compression),
                |packing| packing.name().into(),
            ),
            compression_mode: packing
                .map_or_else(|| told(|metadata| &metadata.compression_mode), |_| "FILE".into()),
        };
        let path = self.path.join(METADATA);
        let text = self.describe().to_yaml_for(style, &stored);
        fs::write(&path, text).map_err(BagError::file(&path))
    }
}

/// Topic indexes by name, type and encoding; topics of several files that agree in these are
/// merged.
#[derive(Default)]
pub(crate) struct TopicIndex(BTreeMap<[String; 3], usize>);

impl TopicIndex {
    pub(crate) fn of<'a>(topics: impl IntoIterator<Item = &'a BagTopic>) -> Self {
        let mut index = Self::default();
        for topic in topics {
            index.add(topic);
        }
        index
    }

    /// Returns the index of a topic, adding it if necessary.
    pub(crate) fn add(&mut self, topic: &BagTopic) -> usize {
        let next = self.0.len();
        *self.0.entry(Self::key(topic)).or_insert(next)
    }

    pub(crate) fn find(&self, topic: &BagTopic) -> Option<usize> {
        self.0.get(&Self::key(topic)).copied()
    }

    fn key(topic: &BagTopic) -> [String; 3] {
        [&topic.name, &topic.type_name, &topic.encoding].map(Clone::clone)
    }
}

/// Files of a folder, with or without metadata.
fn folder_files(
    folder: &Path,
    findings: &mut Diagnostics,
) -> Result<(Vec<PathBuf>, Option<Metadata>), BagError> {
    let path = folder.join(METADATA);
    let length = fs::metadata(&path).map_or(0, |metadata| metadata.len());
    let mut metadata = None;
    if fs::is_file(&path) && length <= LARGEST_METADATA {
        let text = fs::read(&path).map_err(BagError::file(&path))?;
        let mut sources = SourceMap::new();
        let text = String::from_utf8_lossy(&text).into_owned();
        let file = sources.add(path.display().to_string(), text);
        let mut found = Diagnostics::new();
        metadata = read_metadata(file, &sources, &mut found);
        for finding in found.iter() {
            let wrong = format!("`{}`: {}", path.display(), finding.message);
            findings.push(Diagnostic::warning("bad-metadata", wrong));
        }
    }
    let there = bag_files(folder)?;
    let Some(metadata) = metadata else {
        let wrong = format!("`{}` is missing or damaged", path.display());
        findings.push(
            Diagnostic::warning("no-metadata", wrong)
                .help("the files are read without it; `periplus bag reindex` rewrites it"),
        );
        return Ok((there, None));
    };
    let mut files = Vec::new();
    for named in &metadata.info.files {
        // Old metadata includes the folder name. All files are in this folder.
        let Some(name) = Path::new(&named.path).file_name() else { continue };
        let file = folder.join(name);
        if fs::is_file(&file) {
            files.push(file);
        } else {
            let wrong =
                format!("`{}` lists `{}`, which does not exist", path.display(), named.path);
            findings.push(Diagnostic::error("missing-part", wrong));
        }
    }
    let named: BTreeSet<&PathBuf> = files.iter().collect();
    let more: Vec<PathBuf> = there.into_iter().filter(|file| !named.contains(file)).collect();
    for file in &more {
        let wrong = format!("`{}` does not list `{}`", path.display(), file.display());
        findings.push(
            Diagnostic::warning("unnamed-part", wrong)
                .help("it is read as well; `periplus bag reindex` rewrites the metadata"),
        );
    }
    files.extend(more);
    Ok((files, Some(metadata)))
}
