//! Motion primitives of Hybrid-A* and the cost of a step.

use periplus_params::ParamChoice;
use periplus_planners::{PrimitiveSet, SmacMotionModel, StepPenalties, TurnDirection};
use serde_json::{Value, json};

use super::super::Setting;
use crate::{Case, CaseReader, Differences, Unreadable, number, numbers};

/// Primitives of a motion model.
pub(in crate::kinds) fn check_primitives(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let model = given.get("model")?;
    let model = match SmacMotionModel::WORDS.contains(&model.text()?) {
        true => SmacMotionModel::of_word(model.text()?),
        false => return Err(model.unreadable("DUBIN or REEDS_SHEPP")),
    };
    let set = PrimitiveSet::new(
        model,
        given.get("minimum_turning_radius_cells")?.number()?,
        given.get("angle_bins")?.count()?,
        given.get("allow_primitive_interpolation")?.truth()?,
    );
    let projections: Vec<Value> =
        set.primitives.iter().map(|it| json!([number(it.x), number(it.y), it.bins])).collect();
    let costs = numbers(set.primitives.iter().map(|it| it.travel));
    differences.compare_members(
        &[
            (&["increments"], json!(set.increments)),
            (&["projections"], Value::Array(projections)),
            (&["travel_costs"], costs),
        ],
        &expect,
    );
    Ok(())
}

/// A direction; none for the start node.
fn turn(reader: &CaseReader<'_>) -> Result<Option<TurnDirection>, Unreadable> {
    Ok(Some(match reader.text()? {
        "FORWARD" => TurnDirection::Forward,
        "LEFT" => TurnDirection::Left,
        "RIGHT" => TurnDirection::Right,
        "REVERSE" => TurnDirection::Reverse,
        "REV_LEFT" => TurnDirection::ReverseLeft,
        "REV_RIGHT" => TurnDirection::ReverseRight,
        "NONE" => return Ok(None),
        _ => return Err(reader.unreadable("a direction")),
    }))
}

/// Cost of a step.
pub(in crate::kinds) fn check_traversal_cost(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let number_of = |name: &str| given.get(name)?.number();
    let penalties = StepPenalties {
        retrospective: number_of("retrospective_penalty")?,
        cost: number_of("cost_penalty")?,
        non_straight: number_of("non_straight_penalty")?,
        change: number_of("change_penalty")?,
        reverse: number_of("reverse_penalty")?,
        is_quadratic: given.get("use_quadratic_cost_penalty")?.truth()?,
    };
    let to = given.get("to_turn")?;
    let to = turn(&to)?.ok_or_else(|| to.unreadable("a direction"))?;
    let from = turn(&given.get("from_turn")?)?;
    let cost = penalties.step_cost(number_of("travel_cost")?, number_of("cell_cost")?, from, to);
    differences.compare_members(&[(&["cost"], number(cost))], &expect);
    Ok(())
}
