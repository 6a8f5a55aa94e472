//! Saving maps.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use periplus_geometry::Pose2;
use periplus_graph::{Graph, GraphError, NodeSettings, Qos};
use periplus_grid::{Grid, GridInfo, OccupancyGrid};
use periplus_images::Raster;
use periplus_maps::{Distro, Format, Mode, Saving, render, to_message};
use periplus_msgs::nav_msgs;
use periplus_msgs::nav2_msgs::{SaveMap, SaveMapRequest};
use periplus_nav_nodes::map_server::MapSaver;
use periplus_resources::{EntryKind, FileReadError, FileWriteError, Host, Store};
use periplus_ros2cli::map::{SaverCommand, save_to, saver_command};
use periplus_ros2cli::{InGraph, Outcome, Session, Types};
use serde_json::{Value, json};

use super::Setting;
use super::map_pixel::distro_of;
use crate::{Case, CaseReader, Differences, Expected, Unreadable};

/// Commands, requests of the service, or the files of ROS 1.
pub(super) fn check(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, distro) = (case.given(), distro_of(case, distro)?);
    if given.find("commands").is_some() {
        return commands(case, distro, differences);
    }
    if given.find("requests").is_some() {
        return requests(case, distro, differences);
    }
    files(case, distro, differences)
}

fn grid(given: &CaseReader<'_>) -> Result<OccupancyGrid, Unreadable> {
    let (width, height) = (given.get("width")?.count()?, given.get("height")?.count()?);
    let resolution_m = given.get("resolution")?.number()?;
    let [x_m, y_m, yaw_rad] = given.find("origin").map_or(Ok([0.0; 3]), |it| it.array())?;
    let data = given.get("data")?;
    let cells = data.each(cell)?;
    let info = GridInfo::new(resolution_m, width, height, Pose2::new(x_m, y_m, yaw_rad))
        .map_err(|error| given.unreadable(&error.to_string()))?;
    Grid::from_cells(info, cells).map_err(|_| data.unreadable("a value for each cell"))
}

fn cell(given: &CaseReader<'_>) -> Result<i8, Unreadable> {
    i8::try_from(given.integer()?).map_err(|_| given.unreadable("a number from -128 to 127"))
}

/// Files and exit code of `periplus map save`. The map is published on `map`; other topics have no
/// publisher.
fn commands(case: &Case, distro: Distro, differences: &mut Differences) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let map = grid(&given.get("grid")?)?;
    let (mut exits, mut exists, mut sizes, mut yamls) = (vec![], vec![], vec![], vec![]);
    for command in given.get("commands")?.list()? {
        let words = command.text()?.split_whitespace();
        let words: Vec<String> = words.map(str::to_owned).collect();
        let files = Written::default();
        exits.push(program(&words, distro, &map, &files));
        let files = files.0.into_inner().unwrap_or_else(PoisonError::into_inner);
        let with = |ending: &str| {
            files.iter().find(|(path, _)| path.extension().is_some_and(|it| it == ending))
        };
        exists.push(with("yaml").is_some());
        yamls.push(with("yaml").map(|(_, text)| String::from_utf8_lossy(text).into_owned()));
        sizes.extend(with("pgm").map(|(_, picture)| picture.len()));
    }
    sizes.dedup();
    for (name, expected) in expect.members()? {
        match name {
            "exit" => differences.compare(name, &json!(exits), &expected),
            "pgm_bytes" => {
                let got = if sizes.len() == 1 { json!(sizes[0]) } else { json!(sizes) };
                differences.compare(name, &got, &expected);
            }
            "yaml_exists_after" | "yaml_after" => {
                let list = expected.list()?;
                differences.same_count(name, exists.len(), list.len());
                for (at, expected) in list.iter().enumerate() {
                    // Null states nothing here.
                    if expected.input().is_null() {
                        continue;
                    }
                    let got = match name {
                        "yaml_after" => json!(yamls.get(at)),
                        _ => json!(exists.get(at)),
                    };
                    differences.compare(format_args!("{name}[{at}]"), &got, expected);
                }
            }
            _ => differences.not_known(format!("`{}`", expected.path())),
        }
    }
    Ok(())
}

/// Timeout for a map that is not published; short, since publisher and saver are in one program.
const WAIT: Duration = Duration::from_millis(100);

/// Runs `periplus map save` with arguments, and returns its exit code.
fn program(words: &[String], distro: Distro, map: &OccupancyGrid, files: &Written) -> u8 {
    let save = match saver_command(words, &[], distro, Some(WAIT)) {
        SaverCommand::Help(_) => return 0,
        SaverCommand::Wrong { exit_code, .. } => return exit_code,
        SaverCommand::Save(save) => save,
    };
    let graph = Graph::live();
    let run = || -> Outcome {
        let node = graph.node(NodeSettings::new("map_server"))?;
        let publisher = node.publisher("/map", Qos::latched(1))?;
        publisher.publish(to_message(map, "map", Default::default()));
        save_to(
            &mut Session {
                network: &InGraph(graph.clone()),
                types: &Types::Builtin,
                out: &mut io::sink(),
                talk: &mut io::sink(),
                stop: &AtomicBool::new(false),
                json: false,
                spin_time: None,
            },
            &save,
            files,
        )
    };
    run().map_or_else(|failure| failure.exit_code(), |()| 0)
}

/// The files of a map, byte for byte.
fn files(case: &Case, distro: Distro, differences: &mut Differences) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let map = grid(&given)?;
    let name = given.find_any(&["base_name", "name", "map_file_name"]).map(|name| name.text());
    let mut saving = Saving::new(name.transpose()?.unwrap_or("map"), distro);
    if let Some(mode) = given.find("mode") {
        saving.mode = Mode::from_name(mode.text()?).ok_or_else(|| mode.unreadable("a mode"))?;
    }
    if let Some(format) = given.find("image_format") {
        saving.format =
            Format::from_name(format.text()?).ok_or_else(|| format.unreadable("a format"))?;
    }
    for (name, place) in
        [("free_thresh", &mut saving.free_thresh), ("occupied_thresh", &mut saving.occupied_thresh)]
    {
        if let Some(given) = given.find(name) {
            *place = given.number()?;
        }
    }
    let files = render(&map, &saving);
    // The header of a PGM ends behind its third line that is not a comment.
    let mut lines = files.image.split_inclusive(|byte| *byte == b'\n');
    let (mut header, mut count) = (0, 0);
    while count < 3
        && let Some(line) = lines.next()
    {
        header += line.len();
        count += usize::from(!line.starts_with(b"#"));
    }
    let (header, pixels) = files.image.split_at(header);
    let header = String::from_utf8_lossy(header).into_owned();
    let mut named: Vec<(&[&str], Value)> = vec![
        (&["yaml", "yaml_text"], json!(files.yaml)),
        (&["pgm_bytes", "image_bytes"], json!(files.image.len())),
    ];
    if saving.format == Format::Pgm {
        named.push((&["pgm_header"], json!(header)));
        named.push((&["pgm_pixels_top_row_first"], json!(pixels)));
    }
    if let Some(values) = expect.find("yaml_values") {
        compare_yaml(&files.yaml, distro, &values, differences)?;
        named.push((&["yaml_values"], values.input().whole().clone()));
    }
    differences.compare_members(&named, &expect);
    Ok(())
}

/// Compares the YAML file of a saved map, read back.
fn compare_yaml(
    yaml: &str,
    distro: Distro,
    expected: &Expected<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    match super::map_load::values_of_yaml(yaml, distro) {
        Some(values) => differences.compare("yaml", &values, expected),
        None => differences.push("the YAML cannot be read again"),
    }
    Ok(())
}

/// Occupancy to pixels: a row of cells is saved, and its picture read again.
pub(super) fn check_pixels(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let distro = distro_of(case, distro)?;
    let cells = given.get("occupancy")?.each(cell)?;
    let mode = given.get("mode")?;
    let mode = Mode::from_name(mode.text()?).ok_or_else(|| mode.unreadable("a mode"))?;
    let number = |name: &str, usual: f64| given.find(name).map_or(Ok(usual), |it| it.number());
    // Without a loss, and with opacity where there is any.
    let saving = Saving {
        mode,
        format: Format::Png,
        free_thresh: number("free_thresh", 0.25)?,
        occupied_thresh: number("occupied_thresh", 0.65)?,
        ..Saving::new("map", distro)
    };
    let info = GridInfo::new(0.05, cells.len(), 1, Pose2::IDENTITY)
        .map_err(|error| given.unreadable(&error.to_string()))?;
    let map = Grid { info, cells };
    let raster = match Raster::decode(&picture_of(&map, &saving)) {
        Ok(raster) => raster,
        Err(error) => {
            differences.push(error.to_string());
            return Ok(());
        }
    };
    let pixels = raster.bytes.chunks_exact(raster.layout.channels());
    let grey: Vec<i64> = pixels.clone().map(|pixel| i64::from(pixel[0])).collect();
    let alpha = |pixel: &[u8]| match raster.layout.has_alpha() {
        true => pixel.last().copied().unwrap_or(255),
        false => 255,
    };
    let opacity: Vec<u8> = pixels.map(alpha).collect();
    let wish = periplus_maps::Wish { mode: mode.name().into(), ..periplus_maps::Wish::default() };
    let format = wish.settle(distro, 0).map(|(saving, _)| saving.format.ending()).ok();
    differences.compare_members(
        &[
            (&["pixels", "gray", "grey"], json!(grey)),
            (&["alpha"], json!(opacity)),
            (&["default_format"], json!(format)),
        ],
        &expect,
    );
    Ok(())
}

/// ROS 1 writes PGM whatever is asked for.
fn picture_of(map: &OccupancyGrid, saving: &Saving) -> Vec<u8> {
    render(map, saving).image
}

/// Responses of the service. `map` has a valid map, `malformed_map` one with too few cells.
fn requests(case: &Case, distro: Distro, differences: &mut Differences) -> Result<(), Unreadable> {
    let requests = case.given().get("requests")?.list()?;
    let mut results = Vec::new();
    for request in &requests {
        let text = |name: &str| request.find(name).map_or(Ok(""), |it| it.text());
        let number = |name: &str| request.find(name).map_or(Ok(0.0), |it| it.number());
        let asked = SaveMapRequest {
            // Behind a blank is a remark.
            map_topic: text("map_topic")?.split(' ').next().unwrap_or_default().into(),
            map_url: match text("map_url")? {
                "" => "/saved/map".into(),
                url => url.into(),
            },
            image_format: text("image_format")?.into(),
            map_mode: text("map_mode")?.into(),
            free_thresh: number("free_thresh")? as f32,
            occupied_thresh: number("occupied_thresh")? as f32,
        };
        match answer(asked, distro) {
            Ok((result, is_written)) => {
                if result != is_written {
                    let shown = request.shown();
                    differences.push(format!("{shown}: answered {result}, written {is_written}"));
                }
                results.push(result);
            }
            Err(error) => differences.push(error.to_string()),
        }
    }
    differences.compare_members(&[(&["result"], json!(results))], &case.expect());
    Ok(())
}

/// Asks a map saver; what it answers, and whether both files are there.
fn answer(request: SaveMapRequest, distro: Distro) -> Result<(bool, bool), GraphError> {
    let files = Arc::new(Written::default());
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("map_saver"))?;
    let saver = MapSaver::new(node, distro, files.clone())?;
    saver.start();
    let user = graph.node(NodeSettings::new("user"))?;
    let good = nav_msgs::OccupancyGrid {
        data: vec![0, 100, -1, 50],
        ..to_message(&Grid { info: square(), cells: vec![0; 4] }, "map", Default::default())
    };
    let short = nav_msgs::OccupancyGrid { data: vec![0], ..good.clone() };
    let map = user.publisher("/map", Qos::latched(1))?;
    map.publish(good);
    let malformed = user.publisher("/malformed_map", Qos::latched(1))?;
    malformed.publish(short);
    let client = user.client::<SaveMap>("/map_saver/save_map")?;
    graph.settle();
    let pending = client.call(request);
    let mut result = false;
    for step in 1..=100 {
        graph.advance_to(step * 50_000_000);
        if let Some(answered) = pending.take() {
            result = answered.is_ok_and(|answered| answered.result);
            break;
        }
    }
    let written = files.0.lock().unwrap_or_else(PoisonError::into_inner).len();
    Ok((result, written == 2))
}

fn square() -> GridInfo {
    GridInfo { resolution_m: 0.05, width: 2, height: 2, origin: Pose2::IDENTITY }
}

/// Files that are written, and nowhere else.
#[derive(Default)]
struct Written(Mutex<BTreeMap<PathBuf, Vec<u8>>>);

impl Store for Written {
    fn replace(&self, path: &Path, content: &[u8]) -> Result<(), FileWriteError> {
        let mut files = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        files.insert(path.to_owned(), content.to_vec());
        Ok(())
    }
}

impl Host for Written {
    fn read(&self, _: &Path) -> Result<Vec<u8>, FileReadError> {
        Err(FileReadError::Missing)
    }

    fn kind(&self, _: &Path) -> Option<EntryKind> {
        None
    }

    fn list(&self, _: &Path) -> Vec<String> {
        Vec::new()
    }

    fn canonical(&self, _: &Path) -> Option<PathBuf> {
        None
    }

    fn variable(&self, _: &str) -> Option<String> {
        None
    }
}
