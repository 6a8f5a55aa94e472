"""Time values, sleeping, rates and timers of rospy."""

from pathlib import Path

from rospy_programs import run_in_lockstep


def check(folder: Path, source: str, expected: str, **variables: str) -> None:
    assert run_in_lockstep(folder, source, **variables).splitlines() == expected.splitlines()


def test_arithmetic_of_times_and_durations(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import genpy
        import rospy
        from rospy import Duration, Time
        print(Time(5) - Time(3, 500000000), Time(5) + Duration(0.25), Time(5) - Duration(1), Duration(1) + Time(2))
        print(Duration(2) * 1.5, 3 * Duration(1), Duration(1) / 4, Duration(3) / Duration(2), Duration(7) // Duration(2))
        print(-Duration(1.5), abs(Duration(-1)), Duration(-1, 0).to_sec(), Duration(5) % Duration(3), bool(Duration()))
        print(repr(Time(1, 5)), repr(Duration(2)), repr(genpy.Time(1)), Time(1) == genpy.Time(1), Time(1) < Time(2))
        print(Time.from_sec(1.5).nsecs, Time(0, 1500000000).secs, Duration.from_sec(0.1).to_nsec(), Time(3).to_time())
        for wrong in (lambda: Time(-1), lambda: Time(1) + Time(1), lambda: Time(1) < Duration(1), lambda: Time(1.5, 3)):
            try:
                wrong()
            except (TypeError, ValueError) as error:
                print(type(error).__name__)
        """,
        "1500000000 5250000000 4000000000 3000000000\n"
        "3000000000 3000000000 250000000 1.5 3\n"
        "-1500000000 1000000000 -1.0 2000000000 False\n"
        "rospy.Time[1000000005] rospy.Duration[2000000000] genpy.Time[1000000000] True True\n"
        "500000000 1 100000000 3.0\n"
        "TypeError\nTypeError\nTypeError\nValueError",
    )


def test_a_rate_keeps_its_phase_and_starts_from_now_when_late(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy
        rospy.init_node("n")
        begin = rospy.get_time()
        rate = rospy.Rate(10)
        for work in (0.0, 0.05, 0.15, 0.0, 0.5, 0.0):
            rospy.sleep(work)
            rate.sleep()
            print(round(rospy.get_time() - begin, 3))
        """,
        # The second is over before 0.15 s of work are; the turn after that is short. 0.5 s is more than two turns late.
        "0.1\n0.2\n0.35\n0.4\n0.9\n1.0",
    )


def test_a_timer_reports_expected_and_real_times(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy
        rospy.init_node("n")
        begin = rospy.Time.now()
        def since(time):
            return None if time is None else round((time - begin).to_sec(), 3)
        def callback(event):
            print(since(event.last_expected), since(event.current_expected), since(event.current_real), event.last_duration)
            rospy.sleep(0.25)
        timer = rospy.Timer(rospy.Duration(0.5), callback)
        rospy.Timer(rospy.Duration(0.7), lambda event: print("once"), oneshot=True)
        rospy.sleep(1.6)
        timer.shutdown()
        rospy.sleep(2)
        """,
        "None 0.5 0.5 None\nonce\n0.5 1.0 1.0 0.25\n1.0 1.5 1.5 0.25",
    )


def test_a_sleep_is_ended_by_the_shutdown(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy
        rospy.init_node("n")
        rospy.on_shutdown(lambda: print("hook", rospy.is_shutdown()))
        rospy.Timer(rospy.Duration(1), lambda event: rospy.signal_shutdown("enough"), oneshot=True)
        begin = rospy.get_time()
        try:
            rospy.sleep(100)
        except rospy.ROSInterruptException as error:
            print(error, rospy.is_shutdown(), rospy.get_time() - begin)
        """,
        "hook False\nROS shutdown request True 1.0",
    )


def test_log_functions_write_to_stdout_and_stderr(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import re, sys
        import rospy
        sys.stderr = sys.stdout
        rospy.init_node("n", log_level=rospy.DEBUG)
        import os
        os.environ["ROSCONSOLE_FORMAT"] = "[${severity}] ${node} ${function}: ${message}"
        rospy.logdebug("a")
        rospy.loginfo("%s and %d", "b", 5)
        rospy.logwarn({"c": 1})
        rospy.logerr("100%")
        rospy.logfatal("e")
        for i in range(3):
            rospy.loginfo_once("once %d", i)
            rospy.loginfo_throttle(1.5, "throttled %d", i)
            rospy.sleep(1)
        """,
        "[DEBUG] /n <module>: a\n[INFO] /n <module>: b and 5\n[WARN] /n <module>: {'c': 1}\n[ERROR] /n <module>: 100%\n"
        "[FATAL] /n <module>: e\n[INFO] /n <module>: once 0\n[INFO] /n <module>: throttled 0\n[INFO] /n <module>: throttled 2",
    )


def test_a_sleep_of_a_string_is_refused(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy
        rospy.init_node("n")
        for sleep in (lambda: rospy.sleep("1"), lambda: rospy.Duration.from_sec("1")):
            try:
                sleep()
            except TypeError as error:
                print(error)
        """,
        "rospy.sleep() needs a number of seconds or a rospy.Duration, not '1'\n"
        "Duration.from_sec() needs a number of seconds, not '1'\n",
    )


def test_a_shutdown_hook_may_sleep_after_the_end_of_the_simulation(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy
        rospy.init_node("n")
        rospy.on_shutdown(lambda: (rospy.sleep(1), rospy.Rate(2).sleep(), print("stopped", rospy.get_time())))
        rospy.spin()
        try:
            rospy.Publisher("late", rospy.AnyMsg, queue_size=1)
        except rospy.ROSInterruptException as error:
            print(error)
        """,
        "stopped 1011.5\nrospy shutdown\n",
        LONE_END="1010",
    )


def test_a_client_of_an_action_needs_a_node(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import actionlib, rospy
        from actionlib_tutorials.msg import FibonacciAction
        try:
            actionlib.SimpleActionClient("fib", FibonacciAction).wait_for_server()
        except rospy.ROSInitException as error:
            print(error)
        """,
        "ROS node has not been initialized yet. Please call init_node() first\n",
    )
