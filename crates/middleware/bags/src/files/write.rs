//! Writing of bags: a file or a folder, split, compressed, safe against crashes.

mod file;
mod settings;

use std::io::{BufReader, BufWriter, Write as _};
use std::path::{Path, PathBuf};

use crate::{BagInfo, BagTopic, FileInfo, Stamp, Stored, TopicInformation};
use periplus_os::fs::{self, File};

use crate::files::BagError;
use crate::files::bag::{METADATA, TopicIndex};
use crate::files::profile::topic_info;
use file::FileWriter;

pub use settings::{ChunkPacking, Packing, PackingMode, Storage, WriteSettings};

/// Writes a bag of one or more files.
///
/// Messages older than a second survive a crash at any time. In a folder, `metadata.yaml` lists
/// every file from its start, so that other programs find all of them after a crash.
pub struct BagWriter {
    /// Folder with `metadata.yaml`; none for single files.
    folder: Option<PathBuf>,
    /// Path of the files without number and extension.
    stem: PathBuf,
    settings: WriteSettings,
    file: Option<FileWriter>,
    path: PathBuf,
    topics: Vec<(BagTopic, TopicInformation)>,
    index: TopicIndex,
    /// Topic ids in the open file.
    ids: Vec<usize>,
    files: Vec<FileInfo>,
    /// Description of the open file.
    current: FileInfo,
    packed: Vec<u8>,
}

impl BagWriter {
    /// Creates a bag: a single file if the path ends in `.mcap`, `.db3` or `.bag`, otherwise a
    /// `ros2 bag` folder; ROS 1 bags are always files.
    ///
    /// # Errors
    /// When it exists already, cannot be created, or the settings are contradictory.
    pub fn create(path: impl AsRef<Path>, settings: WriteSettings) -> Result<Self, BagError> {
        let path = path.as_ref();
        settings.check(path)?;
        if fs::exists(path) {
            return Err(BagError::Exists(path.to_owned()));
        }
        let is_file = Storage::of_path(path).is_some() || settings.storage == Storage::Ros1;
        let stem = if is_file {
            path.with_extension("")
        } else {
            path.join(path.file_name().unwrap_or_default())
        };
        let parent = if is_file { path.parent() } else { Some(path) };
        if let Some(parent) = parent.filter(|parent| !parent.as_os_str().is_empty()) {
            fs::create_dir_all(parent).map_err(BagError::file(parent))?;
        }
        let mut writer = Self {
            folder: (!is_file).then(|| path.to_owned()),
            stem,
            settings,
            file: None,
            path: path.to_owned(),
            topics: Vec::new(),
            index: TopicIndex::default(),
            ids: Vec::new(),
            files: Vec::new(),
            current: FileInfo { path: String::new(), span_ns: None, messages: 0 },
            packed: Vec::new(),
        };
        writer.open_file()?;
        Ok(writer)
    }

    /// Opens the next file.
    fn open_file(&mut self) -> Result<(), BagError> {
        let is_one = self.folder.is_none() && !self.settings.is_split();
        let number = if is_one { String::new() } else { format!("_{}", self.files.len()) };
        let mut name = self.stem.file_name().unwrap_or_default().to_os_string();
        name.push(format!("{number}.{}", self.settings.storage.ending()));
        self.path = self.stem.with_file_name(&name);
        let mut file = FileWriter::create(&self.path, &self.settings)?;
        self.ids.clear();
        for (topic, _) in &self.topics {
            self.ids.push(file.topic(topic)?);
        }
        self.file = Some(file);
        let path = name.to_string_lossy().into_owned();
        self.current = FileInfo { path, span_ns: None, messages: 0 };
        self.put_metadata()
    }

    /// Closes the open file and compresses it.
    fn close_file(&mut self) -> Result<(), BagError> {
        let Some(file) = self.file.take() else { return Ok(()) };
        file.finish(&self.stored())?;
        let mut info = self.current.clone();
        if self.settings.mode == PackingMode::File {
            let packed = pack_file(&self.path, self.settings.packing)?;
            info.path = packed.file_name().unwrap_or_default().to_string_lossy().into_owned();
        }
        self.files.push(info);
        Ok(())
    }

    /// Adds a topic; a topic of the same name and type is reused.
    ///
    /// # Errors
    /// When the bag cannot store it.
    pub fn topic(&mut self, topic: &BagTopic) -> Result<usize, BagError> {
        if let Some(at) = self.index.find(topic) {
            return Ok(at);
        }
        if let Some(file) = &mut self.file {
            self.ids.push(file.topic(topic)?);
        }
        self.topics.push((topic.clone(), topic_info(topic)));
        Ok(self.index.add(topic))
    }

    /// Writes a message.
    ///
    /// # Errors
    /// When the bag cannot store it, or writing to disk fails.
    pub fn write(&mut self, topic: usize, stamp: Stamp, data: &[u8]) -> Result<(), BagError> {
        if self.is_full(stamp.log_ns) {
            self.close_file()?;
            self.open_file()?;
        }
        let data = match self.settings.mode {
            PackingMode::Message => {
                self.settings
                    .packing
                    .pack(data, &mut self.packed)
                    .map_err(|error| BagError::File(self.path.clone(), error))?;
                &self.packed
            }
            _ => data,
        };
        let (Some(file), Some(id)) = (&mut self.file, self.ids.get(topic)) else {
            return Err(BagError::write(&self.path)(crate::WriteError::UnknownTopic));
        };
        file.write(*id, stamp, data)?;
        if let Some((_, info)) = self.topics.get_mut(topic) {
            info.messages += 1;
        }
        let time_ns = stamp.log_ns;
        let (start, end) = self.current.span_ns.unwrap_or((time_ns, time_ns));
        self.current.span_ns = Some((start.min(time_ns), end.max(time_ns)));
        self.current.messages += 1;
        Ok(())
    }

    /// True if a message of this time needs a new file.
    fn is_full(&self, time_ns: i64) -> bool {
        let is_long = |span_ns: i64| {
            self.current.span_ns.is_some_and(|(start, _)| time_ns.saturating_sub(start) >= span_ns)
        };
        let bytes = self.file.as_ref().map_or(0, FileWriter::bytes);
        self.current.messages > 0
            && (self.settings.max_span_ns.is_some_and(is_long)
                || self.settings.max_bytes.is_some_and(|most| bytes >= most))
    }

    /// Declares that no older messages follow: messages older than a second are written to disk.
    ///
    /// # Errors
    /// When writing to disk fails.
    pub fn advance_to(&mut self, time_ns: i64) -> Result<(), BagError> {
        self.file.as_mut().map_or(Ok(()), |file| file.advance_to(time_ns))
    }

    /// Writes everything to disk.
    ///
    /// # Errors
    /// When writing to disk fails.
    pub fn flush(&mut self) -> Result<(), BagError> {
        self.file.as_mut().map_or(Ok(()), FileWriter::flush)
    }

    /// Completes the bag. Returns its content.
    ///
    /// # Errors
    /// When writing to disk fails.
    pub fn finish(mut self) -> Result<BagInfo, BagError> {
        self.close_file()?;
        self.put_metadata()?;
        Ok(self.info())
    }

    /// Content so far.
    fn info(&self) -> BagInfo {
        let mut files = self.files.clone();
        if self.file.is_some() {
            files.push(self.current.clone());
        }
        let topics = self.topics.iter().map(|(_, info)| info.clone()).collect();
        BagInfo {
            topics,
            files,
            ros_distro: self.settings.ros_distro.clone(),
            custom_data: self.settings.custom_data.clone(),
        }
    }

    fn stored(&self) -> Stored {
        let mode = self.settings.mode;
        let is_packed = mode != PackingMode::None;
        Stored {
            storage: self.settings.storage.identifier().into(),
            compression: if is_packed { self.settings.packing.name().into() } else { "".into() },
            compression_mode: mode.name().into(),
        }
    }

    /// Replaces `metadata.yaml` atomically.
    fn put_metadata(&self) -> Result<(), BagError> {
        let Some(folder) = &self.folder else { return Ok(()) };
        let text = self.info().to_yaml_for(self.settings.style, &self.stored());
        let (path, new) = (folder.join(METADATA), folder.join(".metadata.yaml.new"));
        fs::write(&new, text).map_err(BagError::file(&new))?;
        fs::rename(&new, &path).map_err(BagError::file(&path))
    }
}

/// Compresses a file and removes the original.
fn pack_file(path: &Path, packing: Packing) -> Result<PathBuf, BagError> {
    let mut name = path.as_os_str().to_os_string();
    name.push(format!(".{}", packing.name()));
    let packed = PathBuf::from(name);
    let plain = File::open(path).map_err(BagError::file(path))?;
    let target = File::create(&packed).map_err(BagError::file(&packed))?;
    let target = BufWriter::with_capacity(1 << 20, target);
    let done = packing.pack_all(BufReader::with_capacity(1 << 20, plain), target);
    done.and_then(|mut target| target.flush()).map_err(BagError::file(&packed))?;
    fs::remove_file(path).map_err(BagError::file(path))?;
    Ok(packed)
}
