//! `<population>`: copies of one model.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{DVec3, Pose, Stream};
use periplus_xml::Element;

use super::include::Entity;
use super::model::read_model;
use super::root::Reader;
use crate::draft::{ModelDraft, WorldDraft};
use crate::fields::Fields;

/// Maximum number of models in one population.
const MAX_MODELS: u32 = 10_000;

const KINDS: [&str; 6] = ["random", "uniform", "grid", "linear-x", "linear-y", "linear-z"];

/// Region of the models, in the population's frame.
#[derive(Clone, Copy)]
enum Region {
    Box(DVec3),
    Cylinder { radius_m: f64, length_m: f64 },
}

pub(crate) fn read_population(element: &Element, draft: &mut WorldDraft, reader: &mut Reader<'_>) {
    let mut fields = Fields::new(element, reader.diagnostics);
    let name = fields.required_attribute("name").map_or("population", |it| &*it.value);
    let world_from_population = fields.fixed_pose("world");
    let mut count = fields.count("model_count", 1);
    if count > MAX_MODELS {
        let finding = Diagnostic::error(
            "out-of-range",
            format!("a population has at most {MAX_MODELS} models here, not {count}"),
        );
        fields.diagnostics.push(finding.at(element.origin));
        count = MAX_MODELS;
    }
    let mut region = Region::Box(DVec3::ONE);
    if let Some(mut child) = fields.open("box") {
        region = Region::Box(child.vector("size", DVec3::ONE));
        child.finish();
    }
    if let Some(mut child) = fields.open("cylinder") {
        region = Region::Cylinder {
            radius_m: child.length("radius", 1.0),
            length_m: child.length("length", 1.0),
        };
        child.finish();
    }
    let places = read_distribution(&mut fields, name, count, region);
    let model = fields.child("model");
    let include = fields.child("include");
    fields.verbatim(&["frame"]);
    fields.finish();
    let single = match (model, include) {
        (Some(model), _) => read_model(model, reader),
        (None, Some(include)) => match super::include::read_include(include, reader) {
            Some((Entity::Model(model), _)) => Some(*model),
            _ => None,
        },
        (None, None) => {
            let finding = Diagnostic::error("missing-element", "a population needs a `<model>`");
            reader.diagnostics.push(finding.at(element.origin));
            None
        }
    };
    let Some(single) = single else { return };
    for (index, place) in places.into_iter().enumerate() {
        draft.models.push(clone_at(&single, index, world_from_population, place));
    }
}

/// Copy of a model, with the name that Gazebo Classic gives it; the model's own pose is added to its
/// position.
fn clone_at(single: &ModelDraft, index: usize, frame: Pose, place: DVec3) -> ModelDraft {
    let mut clone = single.clone();
    clone.model.name = format!("{}_clone_{index}", single.model.name);
    let shift = Pose { translation: place, ..Pose::IDENTITY };
    clone.model.parent_from_model = frame * shift * single.model.parent_from_model;
    clone
}

fn read_distribution(
    fields: &mut Fields<'_, '_>,
    name: &str,
    count: u32,
    region: Region,
) -> Vec<DVec3> {
    let Some(mut child) = fields.open("distribution") else {
        return scattered(name, count, region);
    };
    let kind = child.text("type").unwrap_or_else(|| "random".into());
    let rows = child.count("rows", 1).min(MAX_MODELS);
    let columns = child.count("cols", 1).min(MAX_MODELS);
    let step = child.vector("step", DVec3::new(0.5, 0.5, 0.0));
    let places = match kind.as_str() {
        "random" => scattered(name, count, region),
        "uniform" => even(count, region),
        "grid" => grid(rows, columns, step),
        "linear-x" => line(count, extent(region).x * DVec3::X),
        "linear-y" => line(count, extent(region).y * DVec3::Y),
        "linear-z" => line(count, extent(region).z * DVec3::Z),
        other => {
            let place = child.element.child("type").map(Element::text_origin).unwrap_or_default();
            child.diagnostics.push(
                Diagnostic::error("unknown-type", format!("`{other}` is not a distribution"))
                    .at(place)
                    .note(format!("distributions are {}", KINDS.join(", ")))
                    .did_you_mean(place, other, KINDS),
            );
            scattered(name, count, region)
        }
    };
    child.finish();
    places
}

fn extent(region: Region) -> DVec3 {
    match region {
        Region::Box(size) => size,
        Region::Cylinder { radius_m, length_m } => {
            DVec3::new(2.0 * radius_m, 2.0 * radius_m, length_m)
        }
    }
}

/// Point of the region from three numbers in 0..1; uniform if they are.
fn point(region: Region, [u, v, w]: [f64; 3]) -> DVec3 {
    match region {
        Region::Box(size) => (DVec3::new(u, v, w) - 0.5) * size,
        Region::Cylinder { radius_m, length_m } => {
            let (sine, cosine) = libm::sincos(std::f64::consts::TAU * v);
            let radius = radius_m * u.sqrt();
            DVec3::new(radius * cosine, radius * sine, (w - 0.5) * length_m)
        }
    }
}

/// Pseudorandom positions, the same for each reading of a file.
fn scattered(name: &str, count: u32, region: Region) -> Vec<DVec3> {
    let mut stream = Stream::keyed(0, name, 0);
    (0..count).map(|_| point(region, std::array::from_fn(|_| stream.unit()))).collect()
}

/// Low-discrepancy positions: Halton's sequence (J. H. Halton, 1960) in the bases 2, 3, 5.
fn even(count: u32, region: Region) -> Vec<DVec3> {
    (1..=count).map(|index| point(region, [2, 3, 5].map(|base| halton(index, base)))).collect()
}

fn halton(mut index: u32, base: u32) -> f64 {
    let mut value = 0.0;
    let mut weight = 1.0;
    while index > 0 {
        weight /= f64::from(base);
        value += weight * f64::from(index % base);
        index /= base;
    }
    value
}

/// Rows along y, columns along x, centred.
fn grid(rows: u32, columns: u32, step: DVec3) -> Vec<DVec3> {
    let rows = rows.min(MAX_MODELS / columns.max(1));
    let middle = |count: u32| (f64::from(count) - 1.0) / 2.0;
    let mut places = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let x = (f64::from(column) - middle(columns)) * step.x;
            let y = (f64::from(row) - middle(rows)) * step.y;
            places.push(DVec3::new(x, y, 0.0));
        }
    }
    places
}

/// Positions from end to end of a line through the centre.
fn line(count: u32, extent: DVec3) -> Vec<DVec3> {
    let share = |index: u32| match count {
        1 => 0.0,
        _ => f64::from(index) / (f64::from(count) - 1.0) - 0.5,
    };
    (0..count).map(|index| extent * share(index)).collect()
}
