//! `service`.

use expect_test::expect;
use periplus_graph::Actor;
use periplus_msgs::std_srvs;
use periplus_ros2cli::service;

use crate::bench::Bench;

/// A light that can be switched and reports its state.
fn lamp(bench: &Bench) -> Actor<bool> {
    let mut lamp = bench.node("lamp").actor(false);
    lamp.serve::<std_srvs::SetBool>("/switch", |is_on, request, _| {
        *is_on = request.data;
        let message = if *is_on { "it's on" } else { "off" };
        std_srvs::SetBoolResponse { success: true, message: message.into() }
    })
    .unwrap();
    lamp
}

#[test]
fn services_are_listed_and_described() {
    let bench = Bench::new();
    let _lamp = lamp(&bench);
    let person = bench.node("person");
    let _client = person.client::<std_srvs::SetBool>("/switch").unwrap();
    bench.check(
        |session| service::list(session, false, false, false),
        expect![[r#"
        /switch
    "#]],
    );
    bench.check(
        |session| service::list(session, true, false, false),
        expect![[r#"
        /switch [std_srvs/srv/SetBool]
    "#]],
    );
    bench.check(
        |session| service::list(session, false, true, false),
        expect![[r#"
        1
    "#]],
    );
    bench.check(
        |session| service::type_of(session, "switch"),
        expect![[r#"
        std_srvs/srv/SetBool
    "#]],
    );
    bench.check(
        |session| service::type_of(session, "/swich"),
        expect![[r#"
        ! Unknown service '/swich'; did you mean `/switch`?
    "#]],
    );
    bench.check(
        |session| service::info(session, "/switch", true),
        expect![[r#"
        Type: std_srvs/srv/SetBool
        Clients count: 1
          /person
        Services count: 1
          /lamp
    "#]],
    );
    bench.check(
        |session| service::find(session, "std_srvs/SetBool", false, false),
        expect![[r#"
        /switch
    "#]],
    );
    let json = bench.json();
    json.check(|session| service::list(session, false, false, false), expect![[r#"
        {"services":[{"clients":["/person"],"name":"/switch","servers":["/lamp"],"types":["std_srvs/srv/SetBool"]}]}
    "#]]);
}

#[test]
fn services_are_called() {
    let bench = Bench::new();
    let _lamp = lamp(&bench);
    let call = |bench: &Bench, type_name: &str, values: &str| {
        bench.run(|session| service::call(session, "/switch", type_name, values, None))
    };
    expect![[r#"
        requester: making request: std_srvs.srv.SetBool_Request(data=True)

        response:
        std_srvs.srv.SetBool_Response(success=True, message="it's on")

    "#]]
    .assert_eq(&call(&bench, "std_srvs/srv/SetBool", "{data: true}"));
    expect![[r#"
        ! the values do not match std_srvs/srv/SetBool_Request: there is no field `dta`, did you mean `data`?
    "#]].assert_eq(&call(&bench, "std_srvs/SetBool", "{dta: true}"));
    expect![[r#"
        ! the service type `std_srvs/srv/SetBol` is unknown. Did you mean `std_srvs/srv/SetBool`? If it is in a package of yours, give its folder with `--interfaces DIR`, or add the install prefix of `std_srvs` to AMENT_PREFIX_PATH
    "#]].assert_eq(&call(&bench, "std_srvs/SetBol", ""));
    let json = Bench { json: true, ..bench };
    expect![[r#"
        {"message":"off","success":true}
    "#]]
    .assert_eq(&call(&json, "std_srvs/srv/SetBool", ""));
}

#[test]
fn a_service_that_nobody_answers_can_be_given_up() {
    let bench = Bench::new();
    let bench = Bench { stop_after: Some(std::time::Duration::from_millis(1_200)), ..bench };
    bench.check(
        |session| service::call(session, "/nobody", "std_srvs/Trigger", "", None),
        expect![[r#"
            | waiting for service to become available...
            ! interrupted
        "#]],
    );
}
