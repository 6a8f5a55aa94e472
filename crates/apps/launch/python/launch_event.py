"""The base of events."""


class Event:
    name = "event"
