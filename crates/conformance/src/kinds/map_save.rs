//! Saving maps.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use periplus_base::Pose2;
use periplus_graph::{Graph, GraphError, NodeSettings, Qos};
use periplus_grid::{Grid, Lattice, OccupancyGrid};
use periplus_map_nodes::MapSaver;
use periplus_maps::{
    Distro, Format, MapFiles, Mode, Saving, Words, read_words, render, to_message,
};
use periplus_msgs::nav_msgs;
use periplus_msgs::nav2_msgs::{SaveMap, SaveMapRequest};
use periplus_pictures::Raster;
use periplus_resources::{Host, Kind, ReadError, Store};

use super::Setting;
use super::map_pixel::distro_of;
use crate::{Case, Differences, Reader, Unreadable};

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

fn grid(given: &Reader<'_>) -> Result<OccupancyGrid, Unreadable> {
    let (width, height) = (given.get("width")?.count()?, given.get("height")?.count()?);
    let resolution_m = given.get("resolution")?.number()?;
    let [x_m, y_m, yaw_rad] = given.find("origin").map_or(Ok([0.0; 3]), |it| it.array())?;
    let data = given.get("data")?;
    let cells = data.each(cell)?;
    let lattice = Lattice::new(resolution_m, width, height, Pose2::new(x_m, y_m, yaw_rad))
        .map_err(|error| given.unreadable(&error.to_string()))?;
    Grid::from_cells(lattice, cells).map_err(|_| data.unreadable("a value for each cell"))
}

fn cell(given: &Reader<'_>) -> Result<i8, Unreadable> {
    i8::try_from(given.integer()?).map_err(|_| given.unreadable("a number from -128 to 127"))
}

/// What the command writes, and with which code it ends. The map is on `map`; nothing is on others.
fn commands(case: &Case, distro: Distro, differences: &mut Differences) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let map = grid(&given.get("grid")?)?;
    let exits = expect.get("exit")?.each(Reader::integer)?;
    let commands = given.get("commands")?.list()?;
    differences.same("number of exit codes", &commands.len(), &exits.len());
    for (at, (command, exit)) in commands.iter().zip(&exits).enumerate() {
        let command = command.text()?;
        let words: Vec<String> = command.split_whitespace().map(str::to_owned).collect();
        let (code, files) = command_of(&words, distro, &map);
        differences.same(format_args!("exit code of `{command}`"), &code, exit);
        let exists = expect.find("yaml_exists_after").map(|list| list.list()).transpose()?;
        let exists = exists.as_ref().and_then(|list| list.get(at));
        if let Some(expected) = exists.filter(|it| !it.is_null()) {
            let what = format!("`{command}` writes a YAML");
            differences.same(what, &files.is_some(), &expected.truth()?);
        }
        if let (Some(files), Some(size)) = (files, expect.find("pgm_bytes"))
            && files.image_path.ends_with(".pgm")
        {
            let what = format!("bytes of the picture of `{command}`");
            differences.same(what, &files.image.len(), &size.count()?);
        }
    }
    Ok(())
}

fn command_of(words: &[String], distro: Distro, map: &OccupancyGrid) -> (i64, Option<MapFiles>) {
    match read_words(words, distro) {
        Err(_) => (255, None),
        Ok(Words::Help) => (0, None),
        Ok(Words::Save { topic, wish }) => match wish.settle(distro, 0) {
            Ok((saving, _)) if topic.trim_start_matches('/') == "map" => {
                (0, Some(render(map, &saving)))
            }
            _ => (1, None),
        },
    }
}

/// The files of a map, byte for byte.
fn files(case: &Case, distro: Distro, differences: &mut Differences) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let map = grid(&given)?;
    let names = ["base_name", "name", "map_file_name"];
    let name = names.iter().find_map(|name| given.find(name)).map(|name| name.text());
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
    let header = expect.find("pgm_header").map(|it| it.text()).transpose()?;
    if let Some(header) = header {
        let got = files.image.get(..header.len()).unwrap_or(&files.image);
        differences.same("header", String::from_utf8_lossy(got).as_ref(), header);
    }
    if let Some(pixels) = expect.find("pgm_pixels_top_row_first") {
        let got = files.image.get(header.map_or(0, str::len)..).unwrap_or_default();
        differences.same("pixels", got, pixels.each(Reader::byte)?.as_slice());
    }
    for name in ["yaml", "yaml_text"] {
        if let Some(yaml) = expect.find(name) {
            differences.same("YAML", files.yaml.as_str(), yaml.text()?);
        }
    }
    for name in ["pgm_bytes", "image_bytes"] {
        if let Some(size) = expect.find(name) {
            differences.same("bytes of the picture", &files.image.len(), &size.count()?);
        }
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
    let lattice = Lattice::new(0.05, cells.len(), 1, Pose2::IDENTITY)
        .map_err(|error| given.unreadable(&error.to_string()))?;
    let map = Grid { lattice, cells };
    let raster = match Raster::decode(&picture_of(&map, &saving)) {
        Ok(raster) => raster,
        Err(error) => {
            differences.push(error.to_string());
            return Ok(());
        }
    };
    let pixels = raster.bytes.chunks_exact(raster.layout.channels());
    let grey: Vec<i64> = pixels.clone().map(|pixel| i64::from(pixel[0])).collect();
    for name in ["pixels", "gray"] {
        if let Some(expected) = expect.find(name) {
            let expected = expected.each(Reader::integer)?;
            differences.same("number of pixels", &grey.len(), &expected.len());
            for ((cell, got), expected) in map.cells.iter().zip(&grey).zip(expected) {
                differences.whole(format_args!("grey of {cell}"), *got, expected);
            }
        }
    }
    if let Some(expected) = expect.find("alpha") {
        let alpha = |pixel: &[u8]| match raster.layout.has_alpha() {
            true => pixel.last().copied().map_or(255, i64::from),
            false => 255,
        };
        let got: Vec<i64> = pixels.map(alpha).collect();
        differences.same("opacity", &got, &expected.each(Reader::integer)?);
    }
    if let Some(expected) = expect.find("default_format") {
        let wish =
            periplus_maps::Wish { mode: mode.name().into(), ..periplus_maps::Wish::default() };
        let settled = wish.settle(distro, 0).map(|(saving, _)| saving.format.ending());
        differences.same("format", &settled, &Ok(expected.text()?));
    }
    Ok(())
}

/// ROS 1 writes PGM whatever is asked for.
fn picture_of(map: &OccupancyGrid, saving: &Saving) -> Vec<u8> {
    render(map, saving).image
}

/// What the service answers. A good map is on `map`, one that is too short on `malformed_map`.
fn requests(case: &Case, distro: Distro, differences: &mut Differences) -> Result<(), Unreadable> {
    let requests = case.given().get("requests")?.list()?;
    let expected = case.expect().get("result")?.each(|it| it.truth())?;
    differences.same("number of answers", &requests.len(), &expected.len());
    for (request, expected) in requests.iter().zip(&expected) {
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
                differences.same(request.value(), &result, expected);
                differences.same(
                    format_args!("{} is written", request.value()),
                    &is_written,
                    &result,
                );
            }
            Err(error) => differences.push(error.to_string()),
        }
    }
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
        ..to_message(&Grid { lattice: square(), cells: vec![0; 4] }, "map", Default::default())
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

fn square() -> Lattice {
    Lattice { resolution_m: 0.05, width: 2, height: 2, origin: Pose2::IDENTITY }
}

/// Files that are written, and nowhere else.
#[derive(Default)]
struct Written(Mutex<BTreeMap<PathBuf, Vec<u8>>>);

impl Store for Written {
    fn replace(&self, path: &Path, content: &[u8]) -> Result<(), String> {
        let mut files = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        files.insert(path.to_owned(), content.to_vec());
        Ok(())
    }
}

impl Host for Written {
    fn read(&self, _: &Path) -> Result<Vec<u8>, ReadError> {
        Err(ReadError::Missing)
    }

    fn kind(&self, _: &Path) -> Option<Kind> {
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
