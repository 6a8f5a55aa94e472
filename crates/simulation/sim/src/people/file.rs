//! Reader of requests for people in YAML.

use std::path::Path;

use periplus_crowds::{DoorControl, SteeringModel};
use periplus_diagnostics::{Diagnostic, Diagnostics, FileId, Origin, SourceMap, closest};
use periplus_os::Machine;
use periplus_resources::Host as _;
use periplus_yaml::YamlNode;

use super::request::{
    PeopleFile, PeopleRequest, RequestedDoor, RequestedGoal, RequestedParty, RequestedPerson,
    RequestedPlan,
};

/// Maximum number of people of a request.
pub const MAX_PEOPLE_COUNT: usize = 2000;

/// Maximum number of goals: each has a map of the paths to it.
const MAX_GOAL_COUNT: usize = 200;

/// Positions are within this distance of the origin of the world \[m\].
const MAX_POSITION_M: f64 = 1e6;

/// Longest time \[s\].
const MAX_TIME_S: f64 = 1e6;

/// Maximum number of members of a group.
const MAX_MEMBER_COUNT: usize = 10;

const OF_FILE: [&str; 11] = [
    "model",
    "seed",
    "count",
    "spawn",
    "speed",
    "speed_deviation",
    "group_sizes",
    "floor",
    "goals",
    "doors",
    "people",
];
const OF_GOAL: [&str; 4] = ["name", "at", "radius", "stay"];
const OF_DOOR: [&str; 7] = ["name", "from", "to", "control", "open", "range", "opening"];
const OF_PERSON: [&str; 7] = ["name", "at", "radius", "speed", "goals", "repeat", "stand"];
const OF_GROUP: [&str; 4] = ["group", "goals", "repeat", "stand"];
const OF_MEMBER: [&str; 4] = ["name", "at", "radius", "speed"];

type Outcome<T> = Result<T, Box<Diagnostic>>;

/// Reads a request for people from a file. A request with errors is not complete.
#[must_use]
pub fn read_people(path: &Path) -> (PeopleFile, Diagnostics) {
    let mut sources = SourceMap::new();
    let mut findings = Diagnostics::new();
    let request = match Machine.read(path) {
        Ok(bytes) => {
            let text = String::from_utf8_lossy(&bytes).into_owned();
            let file = sources.add(path.display().to_string(), text);
            parse(file, &sources, &mut findings)
        }
        Err(error) => {
            findings.push(
                Diagnostic::error(
                    "unreadable-file",
                    format!("`{}` cannot be read: {error}", path.display()),
                )
                .help("give a number of people, or a YAML file with `count: 20`"),
            );
            PeopleRequest::wandering(0)
        }
    };
    (PeopleFile { request, sources }, findings)
}

/// Reads a request from a text. Invalid entries are left out and reported.
pub(crate) fn parse(
    file: FileId,
    sources: &SourceMap,
    findings: &mut Diagnostics,
) -> PeopleRequest {
    let mut request = PeopleRequest::wandering(0);
    let node = match periplus_yaml::parse(file, sources) {
        Ok(Some(node)) if node.entries().is_some() => node,
        Ok(node) => {
            let kind = node.as_ref().map_or("nothing", YamlNode::kind);
            let message = format!("people are declared by a mapping, not {kind}");
            let span = node.map_or(sources.whole(file), |node| node.span);
            findings.push(*wrong(span, message, "write `count: 20`"));
            return request;
        }
        Err(error) => {
            findings.push(*error);
            return request;
        }
    };
    if let Err(error) = names(&node, "people", &OF_FILE) {
        findings.push(*error);
    }
    let mut note = |outcome: Outcome<()>| {
        if let Err(error) = outcome {
            findings.push(*error);
        }
    };
    note(settings(&node, &mut request));
    note(each(&node, "goals", |entry| {
        let goal = goal(entry, request.goals.len())?;
        if request.goals.len() >= MAX_GOAL_COUNT {
            let message = format!("there are more than {MAX_GOAL_COUNT} goals");
            return Err(wrong(entry.span, message, "remove some of them"));
        }
        if request.goals.iter().any(|known| known.name == goal.name) {
            let message = format!("two goals have the name `{}`", goal.name);
            return Err(wrong(entry.span, message, "give each goal another `name`"));
        }
        request.goals.push(goal);
        Ok(())
    }));
    note(each(&node, "doors", |entry| {
        let door = door(entry, request.doors.len())?;
        if request.doors.iter().any(|known| known.name == door.name) {
            let message = format!("two doors have the name `{}`", door.name);
            return Err(wrong(entry.span, message, "give each door another `name`"));
        }
        request.doors.push(door);
        Ok(())
    }));
    let goals: Vec<String> = request.goals.iter().map(|goal| goal.name.clone()).collect();
    note(each(&node, "people", |entry| {
        let party = party(entry, &goals)?;
        request.parties.push(party);
        Ok(())
    }));
    let named: usize = request.parties.iter().map(|party| party.members.len()).sum();
    if request.count + named > MAX_PEOPLE_COUNT {
        let message = format!("there are more than {MAX_PEOPLE_COUNT} people");
        findings.push(*wrong(node.span, message, "make `count` smaller"));
    } else if request.count + named == 0 && !findings.has_errors() {
        let help = "write `count: 20`, or a list `people:`";
        findings.push(*wrong(node.span, "the file declares no people", help));
    }
    request
}

fn wrong(origin: impl Into<Origin>, message: impl Into<String>, help: &str) -> Box<Diagnostic> {
    Box::new(Diagnostic::error("bad-people", message).at(origin).help(help))
}

/// Reads the numbers and the model of a file.
fn settings(node: &YamlNode, request: &mut PeopleRequest) -> Outcome<()> {
    if let Some(model) = node.get("model") {
        let name = model.text().unwrap_or_default();
        request.model = SteeringModel::named(name).ok_or_else(|| {
            let help =
                format!("use {}", SteeringModel::NAMES.map(|it| format!("`{it}`")).join(" or "));
            wrong(model.span, format!("there is no model `{name}`"), &help)
        })?;
    }
    if let Some(seed) = node.get("seed") {
        let value = seed.integer().and_then(|value| u64::try_from(value).ok());
        let help = "write a whole number from 0, such as 7";
        request.seed = Some(value.ok_or_else(|| wrong(seed.span, "`seed` is not a seed", help))?);
    }
    if let Some(count) = node.get("count") {
        request.count = whole(count, "count", MAX_PEOPLE_COUNT)?;
    }
    if let Some(spawn) = node.get("spawn") {
        request.spawn_area_m = Some(corners(spawn)?);
    }
    if let Some(speed) = node.get("speed") {
        request.mean_speed_m_per_s = within(speed, "speed", 0.1, 3.0)?;
    }
    if let Some(deviation) = node.get("speed_deviation") {
        request.speed_deviation_m_per_s = within(deviation, "speed_deviation", 0.0, 1.0)?;
    }
    if let Some(floor) = node.get("floor") {
        request.floor_m = within(floor, "floor", -1000.0, 1000.0)?;
    }
    if let Some(sizes) = node.get("group_sizes") {
        let help = "write `group_sizes: [1, 1, 2]`: a third of the groups has two people";
        let list = sizes.list().filter(|list| !list.is_empty());
        let list = list.ok_or_else(|| wrong(sizes.span, "`group_sizes` is not a list", help))?;
        let size = |node: &YamlNode| match whole(node, "group_sizes", MAX_MEMBER_COUNT)? {
            0 => Err(wrong(node.span, "a group has no members", help)),
            size => Ok(size),
        };
        request.group_sizes = list.iter().map(size).collect::<Outcome<_>>()?;
    }
    Ok(())
}

fn goal(entry: &YamlNode, number: usize) -> Outcome<RequestedGoal> {
    names(entry, "a goal", &OF_GOAL)?;
    let position_m = required_point(entry, "at", "a goal")?;
    let radius_m = entry.get("radius").map_or(Ok(0.5), |node| within(node, "radius", 0.1, 10.0))?;
    let stay_s = match entry.get("stay") {
        None => [0.0; 2],
        Some(node) if node.list().is_none() => [within(node, "stay", 0.0, MAX_TIME_S)?; 2],
        Some(node) => {
            let [low_s, high_s] = pair(node, "stay")?;
            if !(0.0..=high_s).contains(&low_s) || high_s > MAX_TIME_S {
                let help = "write the shortest and the longest stay in seconds, `stay: [5, 20]`";
                return Err(wrong(node.span, "`stay` is not a range of times", help));
            }
            [low_s, high_s]
        }
    };
    let name = name(entry)?.unwrap_or_else(|| format!("goal_{number}"));
    Ok(RequestedGoal { name, position_m, radius_m, stay_s, origin: entry.span.into() })
}

fn door(entry: &YamlNode, number: usize) -> Outcome<RequestedDoor> {
    names(entry, "a door", &OF_DOOR)?;
    let ends_m = [required_point(entry, "from", "a door")?, required_point(entry, "to", "a door")?];
    let control = entry.get("control");
    let is_automatic = match control.and_then(YamlNode::text) {
        Some("automatic") => true,
        Some("manual") => false,
        None if control.is_none() => true,
        _ => {
            let span = control.map_or(entry.span, |node| node.span);
            return Err(wrong(span, "`control` is not known", "use `automatic` or `manual`"));
        }
    };
    let mut is_open = false;
    if let Some(node) = entry.get("open") {
        is_open = truth(node, "open")?;
    }
    let number_of = |key: &str, default: f64, low: f64, high: f64| {
        entry.get(key).map_or(Ok(default), |node| within(node, key, low, high))
    };
    let (range_m, opening_s) =
        (number_of("range", 1.5, 0.3, 20.0)?, number_of("opening", 1.0, 0.0, 60.0)?);
    if !is_automatic && let Some(node) = entry.get("range").or(entry.get("opening")) {
        let help = "remove it, or set `control: automatic`";
        return Err(wrong(node.span, "only automatic doors have `range` and `opening`", help));
    }
    let control = if is_automatic {
        DoorControl::Automatic { range_m, opening_s }
    } else {
        DoorControl::Manual
    };
    let name = name(entry)?.unwrap_or_else(|| format!("door_{number}"));
    let is_name = name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
        && !name.starts_with(|first: char| first.is_ascii_digit());
    if !is_name {
        let help = "use letters, digits and `_`, since a service has this name";
        return Err(wrong(entry.span, format!("`{name}` is no name of a door"), help));
    }
    Ok(RequestedDoor { name, ends_m, control, is_open, origin: entry.span.into() })
}

fn party(entry: &YamlNode, goals: &[String]) -> Outcome<RequestedParty> {
    let members = match entry.get("group") {
        None => {
            names(entry, "a person", &OF_PERSON)?;
            vec![person(entry)?]
        }
        Some(group) => {
            names(entry, "a group", &OF_GROUP)?;
            let list = group.list().filter(|list| !list.is_empty());
            let help = "write `- group: [{at: [1, 2]}, {at: [1, 3]}]`";
            let list =
                list.ok_or_else(|| wrong(group.span, "`group` is not a list of people", help))?;
            let member = |node: &YamlNode| {
                names(node, "a member of a group", &OF_MEMBER)?;
                person(node)
            };
            list.iter().map(member).collect::<Outcome<_>>()?
        }
    };
    let stands = entry.get("stand").map_or(Ok(false), |node| truth(node, "stand"))?;
    let repeats = entry.get("repeat").map_or(Ok(true), |node| truth(node, "repeat"))?;
    let plan = match entry.get("goals") {
        Some(node) if stands => {
            let help = "remove `goals` or `stand`";
            return Err(wrong(node.span, "a person that remains has no goals", help));
        }
        None if stands => RequestedPlan::Stand,
        None => {
            if let Some(node) = entry.get("repeat") {
                let help = "add `goals: [NAME, NAME]`, or remove `repeat`";
                return Err(wrong(node.span, "`repeat` needs goals", help));
            }
            RequestedPlan::Wander
        }
        Some(node) => RequestedPlan::Visit { goals: indices(node, goals)?, repeats },
    };
    Ok(RequestedParty { members, plan, origin: entry.span.into() })
}

fn person(entry: &YamlNode) -> Outcome<RequestedPerson> {
    let position_m = entry.get("at").map(|node| point(node, "at")).transpose()?;
    let radius_m = entry.get("radius").map_or(Ok(0.2), |node| within(node, "radius", 0.1, 0.5))?;
    let speed = entry.get("speed").map(|node| within(node, "speed", 0.1, 3.0));
    let (name, speed_m_per_s) = (name(entry)?, speed.transpose()?);
    Ok(RequestedPerson { name, position_m, radius_m, speed_m_per_s, origin: entry.span.into() })
}

/// Indices of goals by their names.
fn indices(node: &YamlNode, goals: &[String]) -> Outcome<Vec<usize>> {
    let help = "write the names of goals, `goals: [desk, exit]`";
    let list = node.list().filter(|list| !list.is_empty());
    let list = list.ok_or_else(|| wrong(node.span, "`goals` is not a list of names", help))?;
    let index = |node: &YamlNode| {
        let name = node.text().unwrap_or_default();
        goals.iter().position(|goal| goal == name).ok_or_else(|| {
            let known = goals.iter().map(String::as_str);
            let help = closest(name, known).map_or_else(
                || "declare it in `goals:` of the file, with a `name`".to_owned(),
                |near| format!("did you mean `{near}`?"),
            );
            wrong(node.span, format!("there is no goal `{name}`"), &help)
        })
    };
    list.iter().map(index).collect()
}

/// Calls `read` with each entry of a list; stops at the first error.
fn each(node: &YamlNode, key: &str, mut read: impl FnMut(&YamlNode) -> Outcome<()>) -> Outcome<()> {
    let Some(list) = node.get(key) else { return Ok(()) };
    let help = format!("write `{key}:` and below it an entry in each line, with `- `");
    let entries = list.list().ok_or_else(|| {
        wrong(list.span, format!("`{key}` is a list, not {}", list.kind()), &help)
    })?;
    entries.iter().try_for_each(&mut read)
}

/// Refuses unknown and repeated keys.
fn names(entry: &YamlNode, of: &str, known: &[&str]) -> Outcome<()> {
    let Some(entries) = entry.entries() else {
        let message = format!("{of}: this is {}, not a mapping", entry.kind());
        return Err(wrong(entry.span, message, &format!("use the keys {}", known.join(", "))));
    };
    for (index, (key, _)) in entries.iter().enumerate() {
        let name = key.text().unwrap_or_default();
        if !known.contains(&name) {
            let help = closest(name, known.iter().copied()).map_or_else(
                || format!("the keys are {}", known.join(", ")),
                |near| format!("did you mean `{near}`?"),
            );
            return Err(wrong(key.span, format!("{of}: there is no key `{name}`"), &help));
        }
        if entries[..index].iter().any(|(earlier, _)| earlier.text() == Some(name)) {
            let message = format!("the key `{name}` occurs twice");
            return Err(wrong(key.span, message, "remove one of them"));
        }
    }
    Ok(())
}

fn name(entry: &YamlNode) -> Outcome<Option<String>> {
    let Some(node) = entry.get("name") else { return Ok(None) };
    match node.text().filter(|text| !text.is_empty() && !text.contains(['/', ':', ' '])) {
        Some(text) => Ok(Some(text.to_owned())),
        None => {
            let help = "write a name without spaces, `/` and `:`";
            Err(wrong(node.span, "`name` is not a name", help))
        }
    }
}

fn truth(node: &YamlNode, key: &str) -> Outcome<bool> {
    let message = format!("`{key}` is {}, not a truth value", node.kind());
    node.truth().ok_or_else(|| wrong(node.span, message, "write `true` or `false`"))
}

fn within(node: &YamlNode, key: &str, low: f64, high: f64) -> Outcome<f64> {
    node.number().filter(|number| (low..=high).contains(number)).ok_or_else(|| {
        let message = format!("`{key}` is not a number from {low} to {high}");
        wrong(node.span, message, &format!("write `{key}: {}`", (low + 1.0).min(high)))
    })
}

fn whole(node: &YamlNode, key: &str, max: usize) -> Outcome<usize> {
    let value = node.integer().and_then(|value| usize::try_from(value).ok());
    value.filter(|value| *value <= max).ok_or_else(|| {
        let message = format!("`{key}` is not a whole number from 0 to {max}");
        wrong(node.span, message, &format!("write `{key}: 2`"))
    })
}

fn pair(node: &YamlNode, key: &str) -> Outcome<[f64; 2]> {
    let numbers: Option<Vec<f64>> =
        node.list().and_then(|list| list.iter().map(YamlNode::number).collect());
    match numbers.as_deref() {
        Some([first, second]) => Ok([*first, *second]),
        _ => {
            let message = format!("`{key}` is not two numbers");
            Err(wrong(node.span, message, &format!("write `{key}: [1.0, 2.0]`")))
        }
    }
}

fn point(node: &YamlNode, key: &str) -> Outcome<[f64; 2]> {
    let position_m = pair(node, key)?;
    if position_m.iter().any(|value| value.abs() > MAX_POSITION_M) {
        let message = format!("`{key}` is more than {MAX_POSITION_M} m from the origin");
        return Err(wrong(node.span, message, "write x and y in metres"));
    }
    Ok(position_m)
}

fn required_point(entry: &YamlNode, key: &str, of: &str) -> Outcome<[f64; 2]> {
    let help = format!("add `{key}: [1.0, 2.0]`, x and y in metres");
    let node =
        entry.get(key).ok_or_else(|| wrong(entry.span, format!("{of} has no `{key}`"), &help))?;
    point(node, key)
}

fn corners(node: &YamlNode) -> Outcome<[[f64; 2]; 2]> {
    let help = "write two corners of a rectangle, `spawn: [[0, 0], [10, 5]]`";
    let Some([first, second]) = node.list() else {
        return Err(wrong(node.span, "`spawn` is not two points", help));
    };
    Ok([point(first, "spawn")?, point(second, "spawn")?])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (PeopleRequest, Vec<String>) {
        let mut sources = SourceMap::new();
        let file = sources.add("crowd.yaml", text);
        let mut findings = Diagnostics::new();
        let request = parse(file, &sources, &mut findings);
        let line = |finding: &Diagnostic| {
            let at = finding.span.map(|span| sources.locate(span).1);
            let at = at.map(|at| format!("{}:{}", at.line, at.column)).unwrap_or_default();
            format!("{at} {}; {}", finding.message, finding.help.join("; "))
        };
        (request, findings.iter().map(line).collect())
    }

    #[test]
    fn a_file_declares_goals_doors_people_and_groups() {
        let (request, findings) = read(
            "model: orca\nseed: 7\ncount: 3\nspawn: [[0, 0], [10, 5]]\nspeed: 1.2\ngroup_sizes: [1, 2]\n\
             goals:\n- {name: desk, at: [1, 2], radius: 0.8, stay: [5, 20]}\n- {at: [3, 4], stay: 2}\n\
             doors:\n- {from: [5, 1], to: [5, 2]}\n- {name: lab, from: [7, 1], to: [7, 2], control: manual, open: yes}\n\
             people:\n- {name: anna, at: [1, 1], goals: [desk, goal_1], repeat: false}\n- {at: [2, 2], stand: true}\n\
             - group: [{at: [3, 1], speed: 1}, {radius: 0.25}]\n",
        );
        assert_eq!(findings, Vec::<String>::new());
        assert_eq!((request.model.name(), request.seed, request.count), ("orca", Some(7), 3));
        assert_eq!(request.spawn_area_m, Some([[0.0, 0.0], [10.0, 5.0]]));
        assert_eq!((request.mean_speed_m_per_s, request.group_sizes), (1.2, vec![1, 2]));
        assert_eq!(request.goals[0].stay_s, [5.0, 20.0]);
        assert_eq!((request.goals[1].name.as_str(), request.goals[1].stay_s), ("goal_1", [2.0; 2]));
        let controls =
            request.doors.iter().map(|door| (door.name.as_str(), door.control, door.is_open));
        let automatic = DoorControl::Automatic { range_m: 1.5, opening_s: 1.0 };
        assert_eq!(
            controls.collect::<Vec<_>>(),
            [("door_0", automatic, false), ("lab", DoorControl::Manual, true)]
        );
        let plans: Vec<&RequestedPlan> = request.parties.iter().map(|party| &party.plan).collect();
        let visit = RequestedPlan::Visit { goals: vec![0, 1], repeats: false };
        assert_eq!(plans, [&visit, &RequestedPlan::Stand, &RequestedPlan::Wander]);
        assert_eq!(request.parties[0].members[0].name.as_deref(), Some("anna"));
        assert_eq!(request.parties[2].members[1].radius_m, 0.25);
    }

    #[test]
    fn wrong_entries_are_refused_with_their_line() {
        let check = |text: &str, expected: &str| {
            let (_, findings) = read(text);
            assert_eq!(findings, [expected], "{text}");
        };
        check("cuont: 3\n", "1:1 people: there is no key `cuont`; did you mean `count`?");
        check(
            "count: 3\nmodel: boids\n",
            "2:8 there is no model `boids`; use `social_force` or `orca`",
        );
        check("count: -3\n", "1:8 `count` is not a whole number from 0 to 2000; write `count: 2`");
        check(
            "count: 1\ngoals:\n- {at: [1, 2], radius: 100}\n",
            "3:24 `radius` is not a number from 0.1 to 10; write `radius: 1.1`",
        );
        check(
            "count: 1\ngoals:\n- {name: a}\n",
            "3:3 a goal has no `at`; add `at: [1.0, 2.0]`, x and y in metres",
        );
        check(
            "goals:\n- {name: desk, at: [1, 2]}\npeople:\n- {goals: [dsk]}\n",
            "4:12 there is no goal `dsk`; did you mean `desk`?",
        );
        check(
            "count: 1\ndoors:\n- {from: [1, 2], to: [1, 3], control: manual, range: 2}\n",
            "3:54 only automatic doors have `range` and `opening`; remove it, or set `control: automatic`",
        );
        check("- 3\n", "1:1 people are declared by a mapping, not a list; write `count: 20`");
        check(
            "model: orca\n",
            "1:1 the file declares no people; write `count: 20`, or a list `people:`",
        );
        check("count: 1\ncount: 2\n", "2:1 the key `count` occurs twice; remove one of them");
    }
}
