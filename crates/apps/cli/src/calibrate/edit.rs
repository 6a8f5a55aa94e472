//! Calibrated values written into the texts of a robot.
//!
//! Each target is a number of the expanded document with its calibrated value. Its source is a number of a text: the
//! number itself, or one in a property, an argument's default or a macro call on which it depends. Such a
//! number is found by trial: it is changed by a percent and the robot is expanded again. It is edited only if
//! nothing changes that is not a target or part of the same wheel.

mod document;
mod sites;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use periplus_diagnostics::SourceMap;
use periplus_loader::{LoadContext, LoadedFile, load};
use periplus_resources::{EntryKind, FileReadError, Host};
use periplus_xml::Document;

use self::document::Leaves;
use self::sites::{Site, number_text};

pub(super) use self::document::{Elements, Place};

/// Number of the expanded document with its calibrated value.
#[derive(Clone, Debug)]
pub(super) struct Target {
    /// Name of the value, as in the report.
    pub(super) name: String,
    /// Position in the document.
    pub(super) place: Place,
    /// Calibrated value, in the unit of the document, and its standard error.
    pub(super) value: f64,
    pub(super) standard_error: f64,
}

/// Outcome for a target.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Outcome {
    pub(super) name: String,
    /// `FILE:LINE:COLUMN` of the number in the text, or of the expression.
    pub(super) location: String,
    pub(super) current: f64,
    pub(super) value: f64,
    pub(super) kind: OutcomeKind,
}

/// Kind of an outcome.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum OutcomeKind {
    /// The calibrated value is within two standard errors.
    Agrees,
    /// Edited; with a note if the text has one number for several different values.
    Edited(Option<String>),
    /// Not edited for this reason.
    Manual(String),
}

/// Edited texts of a robot.
#[derive(Debug, Default)]
pub(super) struct Plan {
    pub(super) outcomes: Vec<Outcome>,
    /// Texts before and after, by path.
    pub(super) texts: BTreeMap<PathBuf, (String, String)>,
}

/// The robot's file with its texts, some of which may be changed.
struct Texts<'a> {
    host: &'a dyn Host,
    changed: BTreeMap<PathBuf, String>,
}

impl Host for Texts<'_> {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileReadError> {
        match self.host.canonical(path).and_then(|it| self.changed.get(&it)) {
            Some(text) => Ok(text.clone().into_bytes()),
            None => self.host.read(path),
        }
    }

    fn kind(&self, path: &Path) -> Option<EntryKind> {
        self.host.kind(path)
    }

    fn list(&self, folder: &Path) -> Vec<String> {
        self.host.list(folder)
    }

    fn canonical(&self, path: &Path) -> Option<PathBuf> {
        self.host.canonical(path)
    }

    fn variable(&self, name: &str) -> Option<String> {
        self.host.variable(name)
    }
}

/// Loads the robot with some texts changed.
pub(super) fn expand_texts(
    file: &Path,
    context: &LoadContext<'_>,
    changed: BTreeMap<PathBuf, String>,
) -> LoadedFile {
    let host = Texts { host: context.host, changed };
    let context = LoadContext {
        host: &host,
        resolver: context.resolver,
        working_folder: context.working_folder.clone(),
        arguments: context.arguments.clone(),
        open_meshes: false,
    };
    load(file, &context)
}

/// Expands the robot with some texts changed; none if that fails.
fn expand(
    file: &Path,
    context: &LoadContext<'_>,
    changed: BTreeMap<PathBuf, String>,
) -> Option<Document> {
    let loaded = expand_texts(file, context, changed);
    loaded.document.filter(|_| loaded.is_expanded)
}

/// Numbers of the document that a site changes.
struct Effect {
    site: Site,
    step: f64,
    /// Index of the target, with its change.
    targets: Vec<(usize, f64)>,
    /// First other number that changes and does not belong to the wheels.
    other: Option<Place>,
    count: usize,
}

/// Plans edits of the robot's texts. `owned` are elements whose numbers may change with the targets: those of the
/// wheels.
pub(super) fn plan(
    file: &Path,
    context: &LoadContext<'_>,
    document: &Document,
    sources: &SourceMap,
    targets: &[Target],
    owned: &BTreeSet<usize>,
) -> Plan {
    let leaves = Leaves::of(document);
    let all_sites = sites::all(sources, context);
    let mut outcomes: Vec<Outcome> = targets
        .iter()
        .map(|target| Outcome {
            name: target.name.clone(),
            location: leaves.location(&target.place, sources),
            current: leaves.number(&target.place).unwrap_or(f64::NAN),
            value: target.value,
            kind: OutcomeKind::Agrees,
        })
        .collect();
    let wanted: BTreeSet<usize> = (0..targets.len())
        .filter(|it| {
            let away = (targets[*it].value - outcomes[*it].current).abs();
            away > 2.0 * targets[*it].standard_error && number_text(away, 4) != "0"
        })
        .collect();
    let index_of: BTreeMap<&Place, usize> =
        targets.iter().enumerate().map(|(index, it)| (&it.place, index)).collect();
    let mut effects: BTreeMap<usize, Option<Effect>> = BTreeMap::new();
    let effect_of = |number: usize| {
        let site: &Site = &all_sites[number];
        let step = if site.value == 0.0 { 1e-3 } else { 0.01 * site.value };
        let text = site.replaced(site.value + step, 12);
        let after = expand(file, context, [(site.path.clone(), text)].into());
        let after = after.as_ref().map(Leaves::of)?;
        let mut effect =
            Effect { site: site.clone(), step, targets: Vec::new(), other: None, count: 0 };
        for (place, change) in leaves.changes(&after)? {
            effect.count += 1;
            match index_of.get(&place) {
                Some(index) => effect.targets.push((*index, change)),
                None if leaves.is_inside(&place, owned) => {}
                None => effect.other = effect.other.or(Some(place)),
            }
        }
        Some(effect)
    };
    // Edits by site, with the targets that they set.
    let mut edits: BTreeMap<usize, f64> = BTreeMap::new();
    let mut done: BTreeSet<usize> = BTreeSet::new();
    for &index in &wanted {
        if done.contains(&index) {
            continue;
        }
        let direct = leaves.literal(&targets[index].place, sources, &all_sites);
        let candidates: Vec<usize> = match direct {
            Some(number) => vec![number],
            None => (0..all_sites.len()).filter(|it| all_sites[*it].is_indirect).collect(),
        };
        let mut accepted: Vec<usize> = Vec::new();
        let mut refused: Option<(Site, Place, f64)> = None;
        for number in candidates {
            let effect = effects.entry(number).or_insert_with(|| effect_of(number));
            let Some(effect) = effect else { continue };
            let Some((_, change)) = effect.targets.iter().find(|it| it.0 == index) else {
                continue;
            };
            let away = targets[index].value - outcomes[index].current;
            let asked = effect.site.value + away * effect.step / change;
            match &effect.other {
                None => accepted.push(number),
                Some(other) => {
                    refused.get_or_insert((effect.site.clone(), other.clone(), asked));
                }
            }
        }
        // A number of both wheels before one of each, such as its side; then the one with the fewest effects.
        accepted.sort_by_key(|number| {
            let effect = effects[number].as_ref();
            effect.map(|it| (std::cmp::Reverse(it.targets.len()), it.count))
        });
        let Some(&number) = accepted.first() else {
            outcomes[index].kind = OutcomeKind::Manual(match refused {
                Some((site, other, asked)) => {
                    let other = leaves.location(&other, sources);
                    outcomes[index].location.clone_from(&site.location);
                    format!(
                        "{} for {} there gives it, but changes {other} too",
                        number_text(asked, 6),
                        number_text(site.value, 6)
                    )
                }
                None => "no number of the text sets it".to_owned(),
            });
            continue;
        };
        let Some(effect) = &effects[&number] else { continue };
        // The number that each of its targets asks for.
        let asked: Vec<(usize, f64, f64)> = effect
            .targets
            .iter()
            .map(|&(index, change)| {
                let slope = change / effect.step;
                let away = targets[index].value - outcomes[index].current;
                (index, effect.site.value + away / slope, slope)
            })
            .collect();
        let mean = asked.iter().map(|it| it.1).sum::<f64>() / asked.len() as f64;
        let is_one = asked.iter().all(|(index, asked, slope)| {
            ((asked - mean) * slope).abs() <= 2.0 * targets[*index].standard_error
        });
        let note = (!is_one).then(|| {
            let names: BTreeSet<&str> =
                asked.iter().map(|it| targets[it.0].name.as_str()).collect();
            let names: Vec<&str> = names.into_iter().collect();
            format!("the text has one number for {}; it gets their mean", names.join(", "))
        });
        for (index, ..) in &asked {
            done.insert(*index);
            outcomes[*index].location.clone_from(&effect.site.location);
            outcomes[*index].kind = OutcomeKind::Edited(note.clone());
        }
        edits.insert(number, mean);
    }
    let texts = sites::edited(&all_sites, &edits, sources);
    verify(file, context, targets, &texts, &mut outcomes);
    Plan { outcomes, texts }
}

/// Expands the edited texts: an edited target has its value, or the outcome states that it has not.
fn verify(
    file: &Path,
    context: &LoadContext<'_>,
    targets: &[Target],
    texts: &BTreeMap<PathBuf, (String, String)>,
    outcomes: &mut [Outcome],
) {
    if texts.is_empty() {
        return;
    }
    let changed = texts.iter().map(|(path, it)| (path.clone(), it.1.clone())).collect();
    let document = expand(file, context, changed);
    let leaves = document.as_ref().map(Leaves::of);
    for (target, outcome) in targets.iter().zip(outcomes) {
        let found = leaves.as_ref().and_then(|it| it.number(&target.place));
        if let OutcomeKind::Edited(None) = outcome.kind {
            let is_close = found.is_some_and(|it| {
                (it - target.value).abs() <= 2.0 * target.standard_error + 1e-4 * target.value.abs()
            });
            if !is_close {
                outcome.kind = OutcomeKind::Manual("the edited text does not give it".to_owned());
            }
        } else if let (OutcomeKind::Edited(Some(_)), Some(found)) = (&outcome.kind, found) {
            outcome.value = found;
        }
    }
}
