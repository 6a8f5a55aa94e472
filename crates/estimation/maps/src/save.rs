//! Saving of map files.

use std::fmt;
use std::io::{self, Write};

use periplus_grid::{GridInfo, OccupancyGrid};
use periplus_images::{Layout, pgm_head, write_bmp, write_png};

use crate::distro::{Distro, Mode};
use crate::number::{fixed, general};

/// Grey value of unknown cells.
const UNKNOWN_GREY: u8 = 205;
/// Grey value of free cells.
const FREE_GREY: u8 = 254;

/// Image format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// Uncompressed with a short header.
    #[default]
    Pgm,
    /// Compressed; the only format that preserves unknown cells in mode scale everywhere.
    Png,
    /// Windows bitmap.
    Bmp,
}

impl Format {
    /// Returns a format by its file extension, in upper or lower case.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        [Self::Pgm, Self::Png, Self::Bmp]
            .into_iter()
            .find(|format| format.ending().eq_ignore_ascii_case(name))
    }

    /// Returns the file extension.
    #[must_use]
    pub fn ending(self) -> &'static str {
        match self {
            Self::Pgm => "pgm",
            Self::Png => "png",
            Self::Bmp => "bmp",
        }
    }
}

/// Save request; empty strings and zeros select defaults.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wish {
    /// Path of the files, without extension.
    pub name: String,
    /// `pgm`, `png`, `bmp`.
    pub image_format: String,
    /// `trinary`, `scale`, `raw`.
    pub mode: String,
    /// Minimum occupancy of occupied cells, 0 to 1.
    pub occupied_thresh: f64,
    /// Maximum occupancy of free cells, 0 to 1.
    pub free_thresh: f64,
}

/// Thresholds that are out of range or in the wrong order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BadThresholds {
    /// Threshold of occupied cells.
    pub occupied_thresh: f64,
    /// Threshold of free cells.
    pub free_thresh: f64,
}

impl fmt::Display for BadThresholds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { occupied_thresh, free_thresh } = self;
        write!(
            f,
            "the thresholds are {free_thresh} for free and {occupied_thresh} for occupied; they must \
             lie between 0 and 1, the first below the second, such as 0.25 and 0.65"
        )
    }
}

impl std::error::Error for BadThresholds {}

/// Validated save settings.
#[derive(Clone, Debug, PartialEq)]
pub struct Saving {
    /// Path of the files, without extension.
    pub name: String,
    /// Distribution whose map saver is reproduced.
    pub distro: Distro,
    /// Interpretation of the brightness. ROS 1 writes `trinary` only.
    pub mode: Mode,
    /// Image format. ROS 1 writes PGM only.
    pub format: Format,
    /// Minimum occupancy of occupied cells, 0 to 1.
    pub occupied_thresh: f64,
    /// Maximum occupancy of free cells, 0 to 1.
    pub free_thresh: f64,
}

impl Saving {
    /// Creates the default settings of a map saver, for the files `<name>.pgm` and `<name>.yaml`.
    #[must_use]
    pub fn new(name: impl Into<String>, distro: Distro) -> Self {
        Self {
            name: name.into(),
            distro,
            mode: Mode::Trinary,
            format: Format::Pgm,
            occupied_thresh: 0.65,
            free_thresh: 0.25,
        }
    }
}

impl Wish {
    /// Validates a request and fills in defaults as `nav2_map_server` does: an empty name becomes
    /// `map_<seconds>`, an unknown format or mode becomes PNG or trinary. Each replacement is
    /// reported.
    /// # Errors
    /// When the thresholds are invalid.
    pub fn settle(
        &self,
        distro: Distro,
        unix_s: i64,
    ) -> Result<(Saving, Vec<String>), BadThresholds> {
        let mut said = Vec::new();
        let mut name = self.name.clone();
        if name.is_empty() {
            name = if distro == Distro::Noetic { "map".into() } else { format!("map_{unix_s}") };
            said.push(format!("no name is given; the map is saved as `{name}`"));
        }
        let usual = |value: f64, usual: f64| if value == 0.0 { usual } else { value };
        let occupied_thresh = usual(self.occupied_thresh, 0.65);
        let free_thresh = usual(self.free_thresh, 0.25);
        // Written such that NaN fails as well.
        if !(free_thresh >= 0.0 && occupied_thresh <= 1.0 && free_thresh < occupied_thresh) {
            return Err(BadThresholds { occupied_thresh, free_thresh });
        }
        let mode = Mode::from_name(&self.mode).unwrap_or_else(|| {
            if !self.mode.is_empty() {
                said.push(format!(
                    "`{}` is not a map mode; the map is saved in trinary",
                    self.mode
                ));
            }
            Mode::Trinary
        });
        let format = match self.image_format.as_str() {
            "" if mode == Mode::Scale => Format::Png,
            "" => Format::Pgm,
            name => Format::from_name(name).unwrap_or_else(|| {
                said.push(format!(
                    "the image format `{name}` is not supported; the map is saved as PNG"
                ));
                Format::Png
            }),
        };
        if mode == Mode::Scale && format == Format::Pgm {
            said.push(
                "a PGM cannot represent unknown cells, which mode scale needs; use PNG".into(),
            );
        }
        Ok((Saving { name, distro, mode, format, occupied_thresh, free_thresh }, said))
    }
}

/// Both files of a map.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MapFiles {
    /// Path of the image.
    pub image_path: String,
    /// Contents of the image.
    pub image: Vec<u8>,
    /// Path of the YAML file.
    pub yaml_path: String,
    /// Contents of the YAML file.
    pub yaml: String,
}

/// Renders both files of a map.
///
/// Sources: `map_server/src/map_saver.cpp` (ROS 1), `nav2_map_server/src/map_io.cpp`.
#[must_use]
pub fn render(map: &OccupancyGrid, saving: &Saving) -> MapFiles {
    let (image_path, yaml_path, yaml) = render_yaml(&map.info, saving);
    MapFiles { image: picture(map, &settled(saving)), image_path, yaml_path, yaml }
}

fn picture(map: &OccupancyGrid, saving: &Saving) -> Vec<u8> {
    let side = |cells: usize| u32::try_from(cells).unwrap_or(u32::MAX);
    let (width, height) = (side(map.info.width), side(map.info.height));
    let top_down = map.rows().rev().flatten();
    if saving.mode == Mode::Scale && saving.format != Format::Pgm {
        let pixels: Vec<u8> = top_down
            .flat_map(|&cell| {
                let (grey, alpha) = (scale_grey(cell), if is_known(cell) { 255 } else { 0 });
                [grey, grey, grey, alpha]
            })
            .collect();
        return match saving.format {
            Format::Bmp => write_bmp(width, height, Layout::Rgba, &pixels),
            _ => write_png(width, height, Layout::Rgba, &pixels),
        };
    }
    let table = table(saving);
    let pixels = top_down.map(|cell| table[usize::from(cell.cast_unsigned())]);
    match saving.format {
        Format::Png => write_png(width, height, Layout::Grey, &pixels.collect::<Vec<u8>>()),
        Format::Bmp => write_bmp(width, height, Layout::Grey, &pixels.collect::<Vec<u8>>()),
        Format::Pgm => {
            let mut bytes = head(&map.info, saving).into_bytes();
            bytes.reserve_exact(map.info.len());
            bytes.extend(pixels);
            bytes
        }
    }
}

/// Returns the brightness of each cell value, except for mode scale with unknown cells.
fn table(saving: &Saving) -> [u8; 256] {
    let percent = |share: f64| (share * 100.0).round_ties_even() as i64;
    let (free, occupied) = (percent(saving.free_thresh), percent(saving.occupied_thresh));
    let grey = |cell: i8| match saving.mode {
        Mode::Trinary => trinary_grey(cell, free, occupied, saving.distro),
        Mode::Scale => scale_grey(cell),
        Mode::Raw => {
            if is_known(cell) {
                cell.cast_unsigned()
            } else {
                255
            }
        }
    };
    std::array::from_fn(|value| grey((value as u8).cast_signed()))
}

/// Returns the header of the PGM of a map.
fn head(info: &GridInfo, saving: &Saving) -> String {
    let side = |cells: usize| u32::try_from(cells).unwrap_or(u32::MAX);
    let comment = format!("CREATOR: map_saver.cpp {:.3} m/pix", resolution(info));
    let comment = (saving.distro == Distro::Noetic).then_some(comment.as_str());
    pgm_head(side(info.width), side(info.height), comment)
}

/// Row-wise writer of the PGM of a map, which need not be in memory as a whole.
pub struct PgmRows<'a> {
    out: &'a mut dyn Write,
    table: [u8; 256],
    line: Vec<u8>,
}

impl<'a> PgmRows<'a> {
    /// Begins the image of a map with this grid.
    /// # Errors
    /// When writing fails.
    pub fn begin(
        out: &'a mut dyn Write,
        info: &GridInfo,
        saving: &Saving,
    ) -> io::Result<PgmRows<'a>> {
        let saving = settled(saving);
        out.write_all(head(info, &saving).as_bytes())?;
        Ok(PgmRows { out, table: table(&saving), line: Vec::new() })
    }

    /// Writes the cells of the next row, from the highest row downward.
    /// # Errors
    /// When writing fails.
    pub fn push(&mut self, cells: &[i8]) -> io::Result<()> {
        self.line.clear();
        self.line.extend(cells.iter().map(|cell| self.table[usize::from(cell.cast_unsigned())]));
        self.out.write_all(&self.line)
    }
}

/// Returns the paths of the image and of the YAML file, and the contents of the YAML file.
#[must_use]
pub fn render_yaml(info: &GridInfo, saving: &Saving) -> (String, String, String) {
    let saving = settled(saving);
    let image_path = format!("{}.{}", saving.name, saving.format.ending());
    let yaml = match saving.distro {
        Distro::Noetic => noetic_yaml(info, &image_path),
        _ => yaml(info, &saving, &image_path),
    };
    (image_path, format!("{}.yaml", saving.name), yaml)
}

/// Limits the settings to those that the saver of the distribution supports.
fn settled(saving: &Saving) -> Saving {
    match saving.distro {
        Distro::Noetic => Saving { mode: Mode::Trinary, format: Format::Pgm, ..saving.clone() },
        _ => saving.clone(),
    }
}

/// Messages contain the resolution in single precision, which savers print.
fn resolution(info: &GridInfo) -> f64 {
    f64::from(info.resolution_m as f32)
}

fn is_known(cell: i8) -> bool {
    (0..=100).contains(&cell)
}

fn trinary_grey(cell: i8, free: i64, occupied: i64, distro: Distro) -> u8 {
    // ROS 1 treats all values above the threshold as occupied.
    let is_known = is_known(cell) || distro == Distro::Noetic && cell >= 0;
    let cell = i64::from(cell);
    if !is_known {
        UNKNOWN_GREY
    } else if cell <= free {
        FREE_GREY
    } else if cell >= occupied {
        0
    } else {
        UNKNOWN_GREY
    }
}

/// Converts percentages to brightness, rounded down; unknown cells are half bright.
fn scale_grey(cell: i8) -> u8 {
    match u16::try_from(cell) {
        Ok(percent @ 0..=100) => u8::try_from((100 - percent) * 255 / 100).unwrap_or(255),
        _ => 127,
    }
}

fn yaml(info: &GridInfo, saving: &Saving, image_path: &str) -> String {
    let image = image_path.rsplit(['/', '\\']).next().unwrap_or(image_path);
    let (image, mode) = (scalar(image), saving.mode.name());
    let origin = info.origin;
    let numbers = if saving.distro == Distro::Humble {
        // Three significant digits, not three decimals: 12.345 m is read back as 12.3.
        let short = |value: f64| general(value, 3);
        [
            short(resolution(info)),
            short(origin.x_m),
            short(origin.y_m),
            short(origin.yaw_rad),
            short(saving.occupied_thresh),
            short(saving.free_thresh),
        ]
    } else {
        // The pixels written here need these thresholds, whatever the thresholds of the original.
        let (occupied, free) = match saving.mode {
            Mode::Trinary => ("0.65".into(), "0.196".into()),
            _ => (fixed(saving.occupied_thresh, 3), fixed(saving.free_thresh, 3)),
        };
        [
            fixed(resolution(info), 3),
            fixed(origin.x_m, 3),
            fixed(origin.y_m, 3),
            general(origin.yaw_rad, 7),
            occupied,
            free,
        ]
    };
    let [resolution, x, y, yaw, occupied, free] = numbers;
    format!(
        "image: {image}\nmode: {mode}\nresolution: {resolution}\norigin: [{x}, {y}, {yaw}]\n\
         negate: 0\noccupied_thresh: {occupied}\nfree_thresh: {free}"
    )
}

fn noetic_yaml(info: &GridInfo, image_path: &str) -> String {
    let origin = info.origin;
    format!(
        "image: {image_path}\nresolution: {:.6}\norigin: [{:.6}, {:.6}, {:.6}]\nnegate: 0\n\
         occupied_thresh: 0.65\nfree_thresh: 0.196\n\n",
        resolution(info),
        origin.x_m,
        origin.y_m,
        origin.yaw_rad,
    )
}

/// Writes a scalar as `yaml-cpp` does: without quotes where they are not needed.
fn scalar(text: &str) -> String {
    let is_null = matches!(text, "" | "~" | "null" | "Null" | "NULL");
    let mut characters = text.chars();
    let first = characters.next().unwrap_or(' ');
    let second = characters.next().unwrap_or(' ');
    let starts_plain = match first {
        '-' | '?' | ':' => second != ' ',
        ',' | '[' | ']' | '{' | '}' | '#' | '&' | '*' | '!' | '|' | '>' | '\'' | '"' | '%'
        | '@' | '`' | ' ' => false,
        _ => true,
    };
    let is_plain = starts_plain
        && !is_null
        && !text.ends_with([' ', ':'])
        && !text.contains(": ")
        && !text.contains(" #")
        && !text.chars().any(char::is_control);
    if is_plain {
        return text.to_owned();
    }
    let mut quoted = String::from("\"");
    for character in text.chars() {
        match character {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            '\n' => quoted.push_str("\\n"),
            '\t' => quoted.push_str("\\t"),
            it if it.is_control() => quoted.push_str(&format!("\\x{:02x}", u32::from(it))),
            it => quoted.push(it),
        }
    }
    quoted + "\""
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use periplus_geometry::Pose2;
    use periplus_grid::{Grid, GridInfo};
    use periplus_resources::MemoryHost;
    use proptest::prelude::*;

    use super::*;
    use crate::load::load;

    fn map(width: usize, height: usize, origin: Pose2, cells: &[i8]) -> OccupancyGrid {
        let info = GridInfo::new(0.05, width, height, origin).unwrap();
        Grid::from_cells(info, cells.to_vec()).unwrap()
    }

    #[test]
    fn jazzy_keeps_three_decimals() {
        let map = map(2, 1, Pose2::new(-12.345, 100.25, std::f64::consts::FRAC_PI_2), &[0, 100]);
        let files = render(&map, &Saving::new("maps/my room", Distro::Jazzy));
        assert_eq!(files.image, b"P5\n2 1\n255\n\xfe\x00");
        assert_eq!(files.yaml_path, "maps/my room.yaml");
        expect![[r#"
            image: my room.pgm
            mode: trinary
            resolution: 0.050
            origin: [-12.345, 100.250, 1.570796]
            negate: 0
            occupied_thresh: 0.65
            free_thresh: 0.196"#]]
        .assert_eq(&files.yaml);
        let scale =
            Saving { mode: Mode::Scale, format: Format::Png, ..Saving::new("a", Distro::Jazzy) };
        assert!(render(&map, &scale).yaml.ends_with("occupied_thresh: 0.650\nfree_thresh: 0.250"));
    }

    #[test]
    fn humble_keeps_three_digits() {
        let map = map(1, 1, Pose2::new(-12.345, 100.25, 0.0), &[0]);
        expect![[r#"
            image: a.pgm
            mode: trinary
            resolution: 0.05
            origin: [-12.3, 100, 0]
            negate: 0
            occupied_thresh: 0.65
            free_thresh: 0.25"#]]
        .assert_eq(&render(&map, &Saving::new("a", Distro::Humble)).yaml);
    }

    #[test]
    fn names_that_yaml_would_misread_are_quoted() {
        assert_eq!(scalar("room.pgm"), "room.pgm");
        assert_eq!(scalar("#1.pgm"), "\"#1.pgm\"");
        assert_eq!(scalar("a: \"b\".pgm"), "\"a: \\\"b\\\".pgm\"");
        assert_eq!(scalar("-a.pgm"), "-a.pgm");
    }

    #[test]
    fn what_is_left_open_is_settled() {
        let (saving, said) = Wish::default().settle(Distro::Jazzy, 1_700_000_000).unwrap();
        assert_eq!(saving, Saving::new("map_1700000000", Distro::Jazzy));
        assert_eq!(said.len(), 1);
        let wish = |format: &str, mode: &str| {
            let wish = Wish {
                name: "a".into(),
                image_format: format.into(),
                mode: mode.into(),
                ..Wish::default()
            };
            let (saving, said) = wish.settle(Distro::Jazzy, 0).unwrap();
            (saving.format, saving.mode, said.len())
        };
        assert_eq!(wish("", "scale"), (Format::Png, Mode::Scale, 0));
        assert_eq!(wish("PGM", "Scale"), (Format::Pgm, Mode::Scale, 1));
        assert_eq!(wish("gif", "trinery"), (Format::Png, Mode::Trinary, 2));
        for (free_thresh, occupied_thresh) in
            [(2.0, 2.0), (-2.0, -2.0), (0.7, 0.2), (f64::NAN, 0.5)]
        {
            let wish = Wish { free_thresh, occupied_thresh, ..Wish::default() };
            assert!(wish.settle(Distro::Jazzy, 0).is_err());
        }
    }

    proptest! {
        #[test]
        fn what_is_saved_comes_back(
            cells in prop::collection::vec(prop::sample::select(vec![-1_i8, 0, 100]), 12),
            x_mm in -99_000..99_000_i32, yaw_rad in -3.0..3.0_f64,
            distro in prop::sample::select(vec![Distro::Noetic, Distro::Humble, Distro::Jazzy]),
            format in prop::sample::select(vec![Format::Pgm, Format::Png, Format::Bmp]),
            mode in prop::sample::select(Mode::ALL.to_vec()),
        ) {
            let x_m = f64::from(x_mm) / 1000.0;
            let map = map(4, 3, Pose2::new(x_m, 0.0, yaw_rad), &cells);
            let free_thresh = if mode == Mode::Trinary { 0.196 } else { 0.25 };
            let saving = Saving { mode, format, free_thresh, ..Saving::new("/m/a", distro) };
            let files = render(&map, &saving);
            if saving.format == Format::Pgm || distro == Distro::Noetic {
                let mut rows = Vec::new();
                let mut writer = PgmRows::begin(&mut rows, &map.info, &saving).unwrap();
                for row in map.rows().rev() {
                    writer.push(row).unwrap();
                }
                prop_assert_eq!(&rows, &files.image);
            }
            let host = MemoryHost::new()
                .with_file(&files.image_path, files.image)
                .with_file(&files.yaml_path, files.yaml);
            let read = load("/m/a.yaml", distro, &host).map.unwrap().grid;
            // A PGM of mode scale cannot represent unknown cells, and raw has a value for each.
            if mode != Mode::Scale || format != Format::Pgm || distro == Distro::Noetic {
                prop_assert_eq!(read.cells, cells);
            }
            let coarse_m = if distro == Distro::Humble { 0.6 } else { 0.0006 };
            prop_assert!((read.info.origin.x_m - x_m).abs() < coarse_m);
            prop_assert!((read.info.origin.yaw_rad - yaw_rad).abs() < 0.006);
        }
    }
}
