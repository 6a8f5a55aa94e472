//! Loading of map files.

use std::path::{Path, PathBuf};

use periplus_diagnostics::{Diagnostic, Diagnostics, SourceMap, Span, closest};
use periplus_grid::occupancy::FREE;
use periplus_grid::{Grid, GridInfo, GridInfoError, OccupancyGrid};
use periplus_images::{Layout, Raster};
use periplus_resources::{FileReadError, Host};

use crate::description::{Description, read_description};
use crate::distro::{Distro, Mode};
use crate::rule::luma;

/// Result of loading, with the codes of `nav2_msgs/srv/LoadMap`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The map was loaded.
    Success,
    /// No map was named.
    MapDoesNotExist,
    /// The image is missing or invalid.
    InvalidMapData,
    /// The YAML file is missing or invalid.
    InvalidMapMetadata,
}

impl Status {
    /// Returns the code of `LoadMap`.
    #[must_use]
    pub fn code(self) -> u8 {
        match self {
            Self::Success => 0,
            Self::MapDoesNotExist => 1,
            Self::InvalidMapData => 2,
            Self::InvalidMapMetadata => 3,
        }
    }

    /// Returns the name in `nav2_map_server`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Success => "LOAD_MAP_SUCCESS",
            Self::MapDoesNotExist => "MAP_DOES_NOT_EXIST",
            Self::InvalidMapData => "INVALID_MAP_DATA",
            Self::InvalidMapMetadata => "INVALID_MAP_METADATA",
        }
    }
}

/// A map and the files that it was loaded from.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// Occupancy values.
    pub grid: OccupancyGrid,
    /// Contents of the YAML file.
    pub description: Description,
    /// Path of the image.
    pub image_path: PathBuf,
}

/// Outcome of loading.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The map, unless there was an error.
    pub map: Option<Map>,
    /// Result code.
    pub status: Status,
    /// Source texts.
    pub sources: SourceMap,
    /// Errors and warnings.
    pub diagnostics: Diagnostics,
}

/// File extensions of supported images.
const PICTURES: [&str; 6] = ["pgm", "png", "bmp", "jpg", "jpeg", "ppm"];

/// Replaces a leading `~/` with the home directory, if that is known.
#[must_use]
pub fn expand_home(path: &str, home: &str) -> String {
    match path.strip_prefix('~') {
        Some(rest) if rest.starts_with('/') && !home.is_empty() => format!("{home}{rest}"),
        _ => path.to_owned(),
    }
}

/// Loads a map by the path of its YAML file.
#[must_use]
pub fn load(path: &str, distro: Distro, host: &dyn Host) -> Loaded {
    let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
    let result = read(path, distro, host, &mut sources, &mut diagnostics);
    finish(result, sources, diagnostics)
}

/// Loads a map from an image only, as ROS 1 `map_server IMAGE RESOLUTION` does.
#[must_use]
pub fn load_image(path: &str, resolution_m: f64, distro: Distro, host: &dyn Host) -> Loaded {
    let mut diagnostics = Diagnostics::new();
    let path = expand_home(path, &host.variable("HOME").unwrap_or_default());
    let description = Description::of_image(path.clone(), resolution_m);
    let result = picture(description, PathBuf::from(path), distro, host, &mut diagnostics);
    finish(result, SourceMap::new(), diagnostics)
}

fn finish(result: Result<Map, Failed>, sources: SourceMap, mut diagnostics: Diagnostics) -> Loaded {
    match result {
        Ok(map) => Loaded { map: Some(map), status: Status::Success, sources, diagnostics },
        Err(Failed(status, wrong)) => {
            if let Some(wrong) = wrong {
                diagnostics.push(*wrong);
            }
            Loaded { map: None, status, sources, diagnostics }
        }
    }
}

/// Result code and error, where the error is not reported yet.
struct Failed(Status, Option<Box<Diagnostic>>);

fn failed(status: Status, message: String, span: Option<Span>) -> Failed {
    let mut wrong = Diagnostic::error("bad-map", message);
    wrong.span = span;
    Failed(status, Some(Box::new(wrong)))
}

impl Failed {
    fn help(mut self, help: impl Into<String>) -> Self {
        if let Some(wrong) = self.1.take() {
            self.1 = Some(Box::new(wrong.help(help)));
        }
        self
    }
}

fn read(
    path: &str,
    distro: Distro,
    host: &dyn Host,
    sources: &mut SourceMap,
    diagnostics: &mut Diagnostics,
) -> Result<Map, Failed> {
    if path.is_empty() {
        let wrong = failed(Status::MapDoesNotExist, "no map is given".into(), None);
        return Err(wrong.help("give the path of the YAML file of a map"));
    }
    let path = expand_home(path, &host.variable("HOME").unwrap_or_default());
    let bytes = host.read(Path::new(&path)).map_err(|error| {
        let wrong = format!("cannot read the map `{path}`: {error}");
        let wrong = failed(Status::InvalidMapMetadata, wrong, None);
        with_neighbour(wrong, Path::new(&path), &["yaml", "yml"], host)
    })?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let is_picture = Raster::decode(error.as_bytes()).is_ok();
        let what = if is_picture { "an image" } else { "not a text file" };
        let wrong = format!("`{path}` is {what}, not the YAML file of a map");
        let wrong = failed(Status::InvalidMapMetadata, wrong, None);
        if is_picture { wrong.help("give the YAML file that names the image") } else { wrong }
    })?;
    let file = sources.add(path.as_str(), text);
    let description = read_description(file, sources, distro, diagnostics)
        .ok_or(Failed(Status::InvalidMapMetadata, None))?;
    let image_path = match Path::new(&path).parent() {
        // An absolute path stays unchanged.
        Some(folder) => folder.join(&description.image),
        None => PathBuf::from(&description.image),
    };
    picture(description, image_path, distro, host, diagnostics)
}

/// Reads the image and converts it to a map.
fn picture(
    description: Description,
    image_path: PathBuf,
    distro: Distro,
    host: &dyn Host,
    diagnostics: &mut Diagnostics,
) -> Result<Map, Failed> {
    let span = description.image_span;
    let shown = image_path.display();
    let ending = image_path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    if !PICTURES.contains(&ending.to_ascii_lowercase().as_str()) {
        // A foreign map must not open arbitrary files of this machine.
        let wrong =
            format!("the image `{shown}` of the map is not opened: it is not an image file");
        let wrong = failed(Status::InvalidMapData, wrong, span);
        return Err(wrong.help(format!("its name must end in one of {}", PICTURES.join(", "))));
    }
    let bytes = host.read(&image_path).map_err(|error| {
        let wrong = format!("cannot read the image `{shown}` of the map: {error}");
        let wrong = failed(Status::InvalidMapData, wrong, span);
        match error {
            FileReadError::Missing => with_neighbour(wrong, &image_path, &PICTURES, host),
            _ => wrong,
        }
    })?;
    let raster = Raster::decode(&bytes).map_err(|error| {
        let wrong = format!("cannot use the image `{shown}` of the map: {error}");
        failed(Status::InvalidMapData, wrong, span)
    })?;
    let raster = raster.into_shallow();
    let grid = grid_of(&raster, &description, distro).map_err(|error| {
        failed(Status::InvalidMapData, format!("the map is invalid: {error}"), span)
    })?;
    if let Some(doubt) = lost_unknown(&raster, &description, distro) {
        diagnostics.push(doubt);
    }
    Ok(Map { grid, description, image_path })
}

/// Converts an image with eight bits per sample, with the top row last.
/// # Errors
/// When the grid is invalid or has too many cells.
pub fn grid_of(
    raster: &Raster,
    description: &Description,
    distro: Distro,
) -> Result<OccupancyGrid, GridInfoError> {
    let (width, height) = (raster.width as usize, raster.height as usize);
    let info = GridInfo::new(description.resolution_m, width, height, description.origin)?;
    let rule = description.rule(distro);
    let channels = raster.layout.channels();
    let rows = raster.bytes.chunks_exact((width * channels).max(1)).rev();
    let mut cells = Vec::with_capacity(info.len());
    if raster.layout == Layout::Grey {
        let table: Vec<i8> = (0..=255).map(|grey| rule.occupancy(Layout::Grey, &[grey])).collect();
        cells.extend(rows.flatten().map(|&grey| table[usize::from(grey)]));
    } else {
        let pixels = rows.flat_map(|row| row.chunks_exact(channels));
        cells.extend(pixels.map(|pixel| rule.occupancy(raster.layout, pixel)));
    }
    Ok(Grid { info, cells })
}

/// Map savers write 205 for unknown, a darkness of 0.196: with a higher `free_thresh` all unknown
/// cells become free. `map_saver` of Humble itself writes 0.25 (navigation2, issue 5138).
fn lost_unknown(raster: &Raster, description: &Description, distro: Distro) -> Option<Diagnostic> {
    const UNKNOWN_GREY: u8 = 205;
    if description.mode != Mode::Trinary || description.negate || raster.layout.has_alpha() {
        return None;
    }
    let rule = description.rule(distro);
    let is_free = |grey: u8| rule.occupancy(Layout::Grey, &[grey]) == FREE;
    if !is_free(UNKNOWN_GREY) || description.free_thresh > 0.5 {
        return None;
    }
    let pixels = raster.bytes.chunks_exact(raster.layout.channels());
    let greys = pixels.map(|pixel| luma(raster.layout, pixel));
    let (mut lost, mut savers) = (0_usize, true);
    for grey in greys {
        lost += usize::from(grey == UNKNOWN_GREY);
        savers &= matches!(grey, 0 | UNKNOWN_GREY | 254);
    }
    if lost == 0 || !savers {
        return None;
    }
    let free_thresh = description.free_thresh;
    let wrong = format!("{lost} unknown pixels (grey 205) become free");
    let mut doubt = Diagnostic::warning("unknown-is-free", wrong)
        .note(format!("205 is a darkness of 0.196, and `free_thresh` {free_thresh} is above that"))
        .help("write `free_thresh: 0.196`");
    doubt.span = description.image_span;
    Some(doubt)
}

/// Adds a suggestion of a similar file in the same folder.
fn with_neighbour(wrong: Failed, path: &Path, endings: &[&str], host: &dyn Host) -> Failed {
    let Some(name) = path.file_name().and_then(|name| name.to_str()) else { return wrong };
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let has_ending = |name: &String| {
        let ending = name.rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
        endings.contains(&ending.as_str())
    };
    let names: Vec<String> = host.list(folder).into_iter().filter(has_ending).collect();
    let mut with_ending = endings.iter().map(|ending| format!("{name}.{ending}"));
    let meant = with_ending.find(|it| names.contains(it));
    let near = || closest(name, names.iter().map(String::as_str)).map(str::to_owned);
    match meant.or_else(near) {
        Some(near) => {
            wrong.help(format!("did you mean `{}`?", path.with_file_name(near).display()))
        }
        None => wrong,
    }
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::{RenderStyle, render};
    use periplus_images::{write_bmp, write_png};
    use periplus_resources::MemoryHost;
    use proptest::prelude::*;

    use super::*;

    const YAML: &str = "image: a.pgm\nresolution: 0.5\norigin: [1, 2, 0.5]\nnegate: 0\n\
                        occupied_thresh: 0.65\nfree_thresh: 0.196\n";

    fn host() -> MemoryHost {
        MemoryHost::new()
            .with_file("/m/a.yaml", YAML)
            .with_file("/m/a.pgm", b"P2 3 2 255  0 205 254  254 254 0")
    }

    fn said(loaded: &Loaded) -> String {
        loaded
            .diagnostics
            .iter()
            .map(|it| render(it, &loaded.sources, RenderStyle::Plain))
            .collect()
    }

    #[test]
    fn the_lowest_row_comes_first() {
        let loaded = load("/m/a.yaml", Distro::Jazzy, &host());
        assert_eq!(said(&loaded), "");
        let grid = loaded.map.unwrap().grid;
        assert_eq!(grid.cells, [0, 0, 100, 100, -1, 0]);
        assert_eq!(grid.info.origin.yaw_rad, 0.5);
    }

    #[test]
    fn home_is_expanded() {
        assert_eq!(expand_home("~/a", "/h"), "/h/a");
        assert_eq!(expand_home("~a/b", "/h"), "~a/b");
        let home = host().with_variable("HOME", "/m");
        assert_eq!(load("~/a.yaml", Distro::Jazzy, &home).status, Status::Success);
    }

    #[test]
    fn each_failure_has_its_code() {
        let ends = |path: &str, host: &MemoryHost| {
            let loaded = load(path, Distro::Jazzy, host);
            assert!(loaded.diagnostics.has_errors() && loaded.map.is_none());
            (loaded.status.code(), said(&loaded))
        };
        assert_eq!(ends("", &host()).0, 1);
        let (code, said) = ends("/m/a", &host());
        assert!(code == 3 && said.contains("did you mean `/m/a.yaml`"), "{said}");
        let (code, said) = ends("/m/a.pgm", &host().with_file("/m/a.pgm", b"P5 1 1 255 \xff"));
        assert!(code == 3 && said.contains("an image"), "{said}");
        assert_eq!(ends("/m/a.yaml", &host().with_file("/m/a.yaml", "image: 1")).0, 3);
        assert_eq!(ends("/m/a.yaml", &host().with_file("/m/a.pgm", b"P5 9 9 255 1")).0, 2);
        let lost = host().with_file("/m/a.yaml", YAML.replace("a.pgm", "b.pgm"));
        let (code, said) = ends("/m/a.yaml", &lost);
        assert!(code == 2 && said.contains("a.yaml:1:8") && said.contains("a.pgm"), "{said}");
    }

    #[test]
    fn unknown_that_becomes_free_is_said() {
        let wide = host().with_file("/m/a.yaml", YAML.replace("0.196", "0.25"));
        let loaded = load("/m/a.yaml", Distro::Humble, &wide);
        assert!(said(&loaded).contains("1 unknown pixels"), "{}", said(&loaded));
        assert_eq!(loaded.map.unwrap().grid.cells, [0, 0, 100, 100, 0, 0]);
    }

    proptest! {
        #[test]
        fn no_files_are_too_strange(
            line in 0..7_usize, text in "[a-z0-9.:{}\\[\\], &*!'\"#\n-]{0,30}",
            cut in 0..90_usize, at in 0..90_usize, byte in any::<u8>(), kind in 0..3_usize,
        ) {
            let mut lines: Vec<&str> = YAML.lines().collect();
            if line < lines.len() {
                lines[line] = &text;
            }
            let mut picture = match kind {
                0 => b"P5 3 2 255 123456".to_vec(),
                1 => write_png(3, 2, Layout::Grey, &[0, 1, 2, 3, 4, 5]),
                _ => write_bmp(3, 2, Layout::Grey, &[0, 1, 2, 3, 4, 5]),
            };
            if let Some(place) = picture.get_mut(at) {
                *place = byte;
            }
            picture.truncate(picture.len().max(cut) - cut);
            let host = MemoryHost::new()
                .with_file("/m/a.yaml", lines.join("\n"))
                .with_file("/m/a.pgm", picture);
            for distro in [Distro::Noetic, Distro::Humble, Distro::Jazzy] {
                let loaded = load("/m/a.yaml", distro, &host);
                prop_assert_eq!(loaded.map.is_some(), loaded.status == Status::Success);
                prop_assert_eq!(loaded.map.is_none(), loaded.diagnostics.has_errors());
                if let Some(map) = loaded.map {
                    prop_assert_eq!(map.grid.cells.len(), map.grid.info.len());
                }
            }
        }
    }

    #[test]
    fn a_picture_alone() {
        let loaded = load_image("/m/a.pgm", 0.1, Distro::Noetic, &host());
        assert_eq!(loaded.map.unwrap().grid.cells, [0, 0, 100, 100, -1, 0]);
        assert_eq!(load_image("/m/a.pgm", 0.0, Distro::Noetic, &host()).status.code(), 2);
    }
}
