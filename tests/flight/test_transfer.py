"""The protocol without sockets, in simulated time: with losses and duplicates the vehicle has one whole mission."""

from itertools import chain, repeat
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from flight.vehicle import OLD, Plane, Vehicle, kept, mission, simulated
from loiter.errors import LinkFailed
from loiter.flight.link.link import TIMEOUT_S

NEW = mission("ccw")


def whole(vehicle):
    return kept(NEW) if vehicle.autopilot != 3 else [Plane.home, *kept(NEW)]


@pytest.mark.parametrize("kind", [Vehicle, Plane])
@given(fates=st.lists(st.sampled_from([0, 1, 2]), max_size=120))
@settings(max_examples=150, deadline=None)
def test_the_new_mission_or_the_old_one_whatever_is_lost_or_doubled(kind, fates):
    vehicle = kind([Plane.home, *OLD[1:]] if kind is Plane else OLD)
    fate = chain(fates, repeat(1))
    done, _ = simulated(vehicle, NEW, lambda: next(fate))
    if isinstance(done, LinkFailed):
        assert vehicle.mission[1:] == OLD[1:] or "is not known" in str(done)
    else:
        assert vehicle.mission == whole(vehicle)


@pytest.mark.parametrize("kind", [Vehicle, Plane])
# The same seeds each time: all ten requests of a time-out are lost once in 27,000 times (`link.TIMEOUT_S`).
@given(seed=st.integers(0, 10**9))
@settings(max_examples=100, deadline=None, derandomize=True)
def test_one_packet_of_five_lost_each_way_stops_nothing(kind, seed):
    vehicle, chance = kind(), Random(seed)
    done, seconds = simulated(vehicle, NEW, lambda: int(chance.random() >= 0.2))
    assert not isinstance(done, LinkFailed), done
    assert vehicle.mission == whole(vehicle)
    assert seconds < 60.0


def test_without_losses_no_message_is_sent_twice():
    vehicle = Vehicle()
    simulated(vehicle, NEW)
    assert vehicle.heard["MISSION_COUNT"] == 1
    assert vehicle.heard["MISSION_ITEM_INT"] == len(NEW.items)
    assert vehicle.heard["MISSION_REQUEST_LIST"] == 2
    assert vehicle.heard["MISSION_REQUEST_INT"] == len(OLD) + len(NEW.items)
    assert vehicle.heard["MISSION_ACK"] == 2


@pytest.mark.parametrize("last", range(0, 34, 2))
def test_a_line_that_dies_is_given_up_in_time(last):
    """A time-out without progress, or the last item four times over, and time-outs to ask for what it has and had."""
    left = iter(range(last))
    vehicle = Vehicle()
    done, seconds = simulated(vehicle, NEW, lambda: int(next(left, None) is not None))
    assert isinstance(done, LinkFailed)
    assert seconds < 2.0 * TIMEOUT_S + 4.0 * 1.5 + 0.5
    assert vehicle.mission in (OLD, kept(NEW))


class Tires(Vehicle):
    """Gives up halfway, and sends no item until the whole mission is requested again, like mavsdk's vehicle."""

    tired = False

    def __init__(self, times):
        super().__init__(kept(NEW))
        self.times = times

    def on_mission_request_list(self, message):
        self.tired = False
        super().on_mission_request_list(message)

    def on_mission_request_int(self, message):
        if message.seq == 2 and self.times and not self.tired:
            self.times, self.tired = self.times - 1, True
        if not self.tired:
            super().on_mission_request_int(message)


@pytest.mark.parametrize("times", [1, 2, 4])
def test_a_vehicle_that_gives_up_giving_its_mission_is_asked_again(times):
    """Formerly the same item was requested until the time was up, after the vehicle had given up."""
    vehicle = Tires(times)
    done, seconds = simulated(vehicle, mission("cw"))
    assert not isinstance(done, LinkFailed), done
    assert vehicle.mission == kept(mission("cw"))
    assert 4.0 * times <= seconds < 4.0 * times + 5.0


def test_a_vehicle_that_never_gives_an_item_says_which():
    done, seconds = simulated(Tires(10**9), mission("cw"))
    assert str(done) == "system 1 (PX4) did not answer in 15 s when asked to give item 3"
    assert seconds < 4.0 * 4.0 + TIMEOUT_S + 1.0
