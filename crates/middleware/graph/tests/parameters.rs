//! Parameters, seen from other nodes.
#![allow(clippy::unwrap_used, reason = "tests unwrap values that must exist")]

use std::sync::Arc;

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::{
    Arguments, Graph, Node, NodeSettings, ParameterFileError, ParameterRejection, Qos,
    parameter_from_yaml, parameter_to_yaml,
};
use periplus_msgs::Service;
use periplus_msgs::rcl_interfaces::{
    DescribeParameters, DescribeParametersRequest, GetParameters, GetParametersRequest,
    ListParameters, ListParametersRequest, Parameter, ParameterEvent, ParameterType,
    ParameterValue, SetParameters, SetParametersAtomically, SetParametersAtomicallyRequest,
    SetParametersRequest,
};
use periplus_params::{Given, ParamValues, Table, choice, number};

static LAMP: Table = Table {
    name: "lamp",
    doc: "A lamp that blinks.",
    parameters: &[
        number("blink.period", "s", "Time from flash to flash.").or("2").above(0.0),
        choice("colour", &["red", "green"], "What it looks like.").or("red"),
        number("height", "m", "Mounting height."),
    ],
};

fn values() -> ParamValues {
    let mut diagnostics = Diagnostics::new();
    let values = LAMP.check([Given::new("blink.period", "0.5")], None, &mut diagnostics);
    assert!(diagnostics.is_empty());
    values
}

fn ask<S: Service>(graph: &Graph, user: &Node, name: &str, request: S::Request) -> S::Response {
    let client = user.client::<S>(name).unwrap();
    let pending = client.call(request);
    graph.settle();
    (*pending.take().unwrap().unwrap()).clone()
}

fn double(name: &str, double_value: f64) -> Parameter {
    let r#type = ParameterType::PARAMETER_DOUBLE;
    let value = ParameterValue { r#type, double_value, ..Default::default() };
    Parameter { name: name.into(), value }
}

fn word(name: &str, text: &str) -> Parameter {
    let r#type = ParameterType::PARAMETER_STRING;
    let value = ParameterValue { r#type, string_value: text.into(), ..Default::default() };
    Parameter { name: name.into(), value }
}

#[test]
fn others_list_read_and_describe_them() {
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("lamp")).unwrap();
    let _parameters = node.parameters(values()).unwrap();
    let user = graph.node(NodeSettings::new("user")).unwrap();
    let list = ListParametersRequest::default();
    let listed = ask::<ListParameters>(&graph, &user, "/lamp/list_parameters", list).result;
    assert_eq!(listed.names, ["blink.period", "colour", "height", "use_sim_time"]);
    assert_eq!(listed.prefixes, ["blink"]);

    let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    let get = GetParametersRequest { names: names(&["blink.period", "height", "use_sim_time"]) };
    let got = ask::<GetParameters>(&graph, &user, "/lamp/get_parameters", get).values;
    assert_eq!(got[0].double_value, 0.5);
    assert_eq!(got[1].r#type, ParameterType::PARAMETER_NOT_SET);
    assert!(got[2].bool_value);

    let describe = DescribeParametersRequest { names: names(&["blink.period", "colour"]) };
    let name = "/lamp/describe_parameters";
    let described = ask::<DescribeParameters>(&graph, &user, name, describe).descriptors;
    assert_eq!(described[0].description, "Time from flash to flash. [s]");
    assert_eq!(described[0].additional_constraints, "above 0");
    assert_eq!(described[0].floating_point_range[0].to_value, f64::MAX);
    assert_eq!(described[1].additional_constraints, "one of red, green");
}

#[test]
fn others_set_them_and_the_node_may_refuse() {
    let graph = Graph::new();
    let mut lamp = graph.node(NodeSettings::new("lamp")).unwrap().actor(0.0);
    let parameters = lamp
        .parameters(values(), |period, values, _| {
            let wanted = values.number("blink.period").unwrap();
            if wanted > 10.0 {
                return Err(ParameterRejection::new("the period is too long"));
            }
            *period = wanted;
            Ok(())
        })
        .unwrap();
    let user = graph.node(NodeSettings::new("user")).unwrap();
    let events = user.mailbox::<ParameterEvent>("/parameter_events", Qos::parameters()).unwrap();
    let set = |parameters: Vec<Parameter>| {
        let request = SetParametersRequest { parameters };
        let response = ask::<SetParameters>(&graph, &user, "/lamp/set_parameters", request);
        response.results.into_iter().map(|one| one.reason).collect::<Vec<_>>()
    };
    assert_eq!(
        set(vec![
            double("blink.period", 4.0),
            double("blink.period", 0.0),
            double("blink.period", 11.0),
            double("blink.perod", 1.0),
            word("blink.period", "fast"),
            word("colour", "Green"),
            word("colour", "blue"),
        ]),
        [
            "",
            "`blink.period`: the value is out of range: 0 s must be above 0",
            "the period is too long",
            "/lamp has no parameter `blink.perod`, did you mean `blink.period`?",
            "`blink.period`: the value is of another kind: fast where number belongs",
            "",
            "`colour`: the value is none of `red`, `green`",
        ]
    );
    assert_eq!(lamp.with(|period| *period), 4.0);
    assert_eq!(parameters.generation(), 2);
    assert_eq!(parameters.values().text("colour"), Some("green".into()));
    let changed: Vec<Arc<ParameterEvent>> = events.drain();
    assert_eq!(changed.len(), 2);
    assert_eq!(changed[0].changed_parameters, [double("blink.period", 4.0)]);
    assert_eq!(changed[0].node, "/lamp");

    // All or none.
    let request = SetParametersAtomicallyRequest {
        parameters: vec![double("blink.period", 3.0), word("colour", "blue")],
    };
    let name = "/lamp/set_parameters_atomically";
    let response = ask::<SetParametersAtomically>(&graph, &user, name, request);
    assert!(!response.result.successful);
    assert_eq!(lamp.with(|period| *period), 4.0);
}

#[test]
fn one_program_has_one_time() {
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("lamp")).unwrap();
    let _parameters = node.parameters(values()).unwrap();
    let r#type = ParameterType::PARAMETER_BOOL;
    let value = ParameterValue { r#type, bool_value: false, ..Default::default() };
    let set = Parameter { name: "use_sim_time".into(), value };
    let request = SetParametersRequest { parameters: vec![set] };
    let name = "/lamp/set_parameters";
    let response = ask::<SetParameters>(&graph, &node, name, request.clone());
    assert_eq!(
        response.results[0].reason,
        "`use_sim_time` is true: all nodes of this program run on simulated time"
    );
    graph.set_simulated_time(false);
    assert!(ask::<SetParameters>(&graph, &node, name, request).results[0].successful);
}

fn arguments(line: &str) -> Arguments {
    let words: Vec<String> = line.split(' ').map(str::to_owned).collect();
    let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
    let none = &mut |_: &std::path::Path| Err(ParameterFileError::Missing);
    let arguments = Arguments::read(&words, &mut sources, &mut diagnostics, none);
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    arguments
}

#[test]
fn every_node_has_parameters() {
    let graph = Graph::new();
    let user = graph.node(NodeSettings::new("user").namespace("demo")).unwrap();
    let events = user.mailbox::<ParameterEvent>("/parameter_events", Qos::parameters()).unwrap();
    graph.advance_to(1_500_000_000);
    let plain = graph.node(NodeSettings::new("plain")).unwrap();
    let told = events.drain();
    assert_eq!((told[0].node.as_str(), told[0].stamp.sec), ("/plain", 1));
    assert_eq!((told[0].stamp.nanosec, told[0].new_parameters.len()), (500_000_000, 1));
    assert_eq!(told[0].new_parameters[0].name, "use_sim_time");
    let list = ListParametersRequest::default();
    let listed = ask::<ListParameters>(&graph, &user, "/plain/list_parameters", list).result;
    assert_eq!(listed.names, ["use_sim_time"]);
    let services = graph.services().into_iter().filter(|one| one.server == Some("/plain".into()));
    let names: Vec<String> = services.map(|one| one.name).collect();
    assert_eq!(
        names,
        [
            "/plain/describe_parameters",
            "/plain/get_parameter_types",
            "/plain/get_parameters",
            "/plain/get_type_description",
            "/plain/list_parameters",
            "/plain/set_parameters",
            "/plain/set_parameters_atomically"
        ]
    );
    drop(plain);
    assert!(!graph.services().iter().any(|one| one.server == Some("/plain".into())));
    let bare = graph.node(NodeSettings::new("bare").bare()).unwrap();
    assert!(!graph.services().iter().any(|one| one.name.starts_with("/bare/")));
    assert_eq!(graph.nodes()[0].name, bare.full_name());
}

#[test]
fn parameters_come_change_and_go() {
    let graph = Graph::new();
    let user = graph.node(NodeSettings::new("user")).unwrap();
    let _any = graph.node(NodeSettings::new("any").any_parameters()).unwrap();
    let events = user.mailbox::<ParameterEvent>("/parameter_events", Qos::parameters()).unwrap();
    let set = |parameters: Vec<Parameter>| {
        let request = SetParametersRequest { parameters };
        ask::<SetParameters>(&graph, &user, "/any/set_parameters", request).results.remove(0).reason
    };
    let unset = Parameter { name: "x".into(), value: ParameterValue::default() };
    assert_eq!(set(vec![double("x", 1.0)]), "");
    assert_eq!(set(vec![word("x", "one")]), "");
    assert_eq!(set(vec![unset.clone()]), "");
    assert_eq!(set(vec![unset.clone()]), "/any has no parameter `x`");
    let told = events.drain();
    assert_eq!(told.len(), 3);
    assert_eq!(told[0].new_parameters, [double("x", 1.0)]);
    assert_eq!(told[1].changed_parameters, [word("x", "one")]);
    assert_eq!(told[2].deleted_parameters, [unset]);
}

#[test]
fn arguments_come_before_what_a_node_declares() {
    let graph = Graph::new();
    graph.set_arguments(arguments(
        "-p blink.period:=4 -p /hall/lamp:colour:=grean -p lmap:height:=1 -p hight:=2 -r lamp:__ns:=/hall",
    ));
    let lamp = graph.node(NodeSettings::new("lamp")).unwrap();
    assert_eq!(lamp.full_name(), "/hall/lamp");
    assert!(lamp.parameter("blink.period").is_none(), "nothing is declared yet");
    let parameters = lamp.parameters(values()).unwrap();
    assert_eq!(parameters.values().number("blink.period"), Some(4.0));
    assert_eq!(parameters.values().text("colour"), Some("red".into()));
    assert_eq!(parameter_to_yaml(&lamp.parameter("blink.period").unwrap()), "4.0");
    let messages = |found: Diagnostics| -> Vec<String> {
        found.iter().map(|finding| finding.message.clone()).collect()
    };
    assert_eq!(
        messages(graph.take_findings()),
        [
            "a parameter of `/hall/lamp` keeps its default: `colour`: the value is none of `red`, `green`"
        ]
    );
    assert_eq!(
        messages(graph.unused_arguments()),
        [
            "no node that matches `/**` has a parameter `hight`",
            "there are parameters for `/lmap`, but no such node"
        ]
    );
    // Arguments for one node take precedence over those for all.
    let own = NodeSettings::new("own").parameter("blink.period", parameter_from_yaml("1").unwrap());
    let own = graph.node(own).unwrap().parameters(values()).unwrap();
    assert_eq!(own.values().number("blink.period"), Some(1.0));
    assert!(own.set("blink.period", periplus_params::ParamValue::Number(-1.0)).is_err());
    own.set("blink.period", periplus_params::ParamValue::Number(7.0)).unwrap();
    assert_eq!((own.values().number("blink.period"), own.generation()), (Some(7.0), 1));
}

#[test]
fn who_goes_is_asked_no_more() {
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("lamp")).unwrap();
    let mut actor = node.actor(());
    let parameters =
        actor.parameters(values(), |(), _, _| Err(ParameterRejection::new("never"))).unwrap();
    let request = SetParametersRequest { parameters: vec![double("height", 2.0)] };
    let set = |request: &SetParametersRequest| {
        let name = "/lamp/set_parameters";
        ask::<SetParameters>(&graph, &node, name, request.clone()).results.remove(0).reason
    };
    assert_eq!(set(&request), "never");
    drop(actor);
    assert_eq!(set(&request), "");
    assert_eq!(parameters.values().number("height"), Some(2.0));
    assert!(node.parameters(values()).is_err(), "there is a table already");
}
