//! Writing recordings: a file or a folder, split, packed, safe against the end of the program.

mod file;
mod settings;

use std::fs::{self, File};
use std::io::{BufReader, BufWriter, Write as _};
use std::path::{Path, PathBuf};

use crate::{BagInfo, BagTopic, FileInfo, Stamp, Stored, TopicInfo};

use crate::files::BagError;
use crate::files::bag::{METADATA, TopicIndex};
use crate::files::profile::topic_info;
use file::FileWriter;

pub use settings::{ChunkPacking, Packing, PackingMode, Storage, WriteSettings};

/// Writes a recording of one file or many.
///
/// Everything that is a second old is on the disk whenever the program ends. In a folder,
/// `metadata.yaml` names every file from its beginning, so that others find them all after a crash.
pub struct BagWriter {
    /// The folder with its `metadata.yaml`; none for single files.
    folder: Option<PathBuf>,
    /// Folder and name of the files, without number and ending.
    stem: PathBuf,
    settings: WriteSettings,
    file: Option<FileWriter>,
    path: PathBuf,
    topics: Vec<(BagTopic, TopicInfo)>,
    index: TopicIndex,
    /// What a topic is called in the open file.
    ids: Vec<usize>,
    files: Vec<FileInfo>,
    /// Of the open file.
    current: FileInfo,
    packed: Vec<u8>,
}

impl BagWriter {
    /// Begins a recording: a single file when the path ends in `.mcap`, `.db3` or `.bag`, otherwise
    /// a folder as `ros2 bag` makes it; bags of ROS 1 are always files.
    ///
    /// # Errors
    /// When it is there already, cannot be made, or the settings contradict each other.
    pub fn create(path: impl AsRef<Path>, settings: WriteSettings) -> Result<Self, BagError> {
        let path = path.as_ref();
        settings.check(path)?;
        if path.exists() {
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

    /// Closes the open file and packs it.
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

    /// Adds a topic; one that is there with the same type is the same.
    ///
    /// # Errors
    /// When the recording cannot hold it.
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

    /// Records a message of a topic.
    ///
    /// # Errors
    /// When the recording cannot hold it, or the disk does not take it.
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

    /// Whether the open file may not take a message of this time.
    fn is_full(&self, time_ns: i64) -> bool {
        let is_long = |span_ns: i64| {
            self.current.span_ns.is_some_and(|(start, _)| time_ns.saturating_sub(start) >= span_ns)
        };
        let bytes = self.file.as_ref().map_or(0, FileWriter::bytes);
        self.current.messages > 0
            && (self.settings.max_span_ns.is_some_and(is_long)
                || self.settings.max_bytes.is_some_and(|most| bytes >= most))
    }

    /// Says that nothing older than this will come: what has waited for a second goes to the disk.
    ///
    /// # Errors
    /// When the disk does not take it.
    pub fn advance_to(&mut self, time_ns: i64) -> Result<(), BagError> {
        self.file.as_mut().map_or(Ok(()), |file| file.advance_to(time_ns))
    }

    /// Puts all on the disk.
    ///
    /// # Errors
    /// When the disk does not take it.
    pub fn flush(&mut self) -> Result<(), BagError> {
        self.file.as_mut().map_or(Ok(()), FileWriter::flush)
    }

    /// Ends the recording. Returns what is in it.
    ///
    /// # Errors
    /// When the disk does not take it.
    pub fn finish(mut self) -> Result<BagInfo, BagError> {
        self.close_file()?;
        self.put_metadata()?;
        Ok(self.info())
    }

    /// What is in it so far.
    fn info(&self) -> BagInfo {
        let mut files = self.files.clone();
        if self.file.is_some() {
            files.push(self.current.clone());
        }
        let topics = self.topics.iter().map(|(_, info)| info.clone()).collect();
        BagInfo { topics, files, ros_distro: self.settings.ros_distro.clone() }
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

    /// Writes `metadata.yaml` in one step: it is always whole.
    fn put_metadata(&self) -> Result<(), BagError> {
        let Some(folder) = &self.folder else { return Ok(()) };
        let text = self.info().to_yaml_for(self.settings.style, &self.stored());
        let (path, new) = (folder.join(METADATA), folder.join(".metadata.yaml.new"));
        fs::write(&new, text).map_err(BagError::file(&new))?;
        fs::rename(&new, &path).map_err(BagError::file(&path))
    }
}

/// Packs a whole file and takes the plain one away.
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
