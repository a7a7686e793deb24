"""What costs too much, comes too slowly or is no HTTP is refused cleanly, over real sockets, and the server goes on."""

import asyncio
import json
import threading
import time
from contextlib import ExitStack

import httpx
import pytest
from starlette.exceptions import HTTPException

from loiter.web.limits import MOST_BYTES, MOST_DEPTH, depth
from loiter.web.workers import Workers
from web.serving import answered, asking, connected, encoded, heard, serving
from web.test_api import STILL, WINDY

# Seconds that the impatient server waits; a request on a busy machine takes less.
PATIENCE = 1.0
HEAD = b"POST /api/plan HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"


@pytest.fixture(scope="module")
def impatient():
    """The port of a server that soon loses its patience."""
    with serving(connections__HEAD_S=PATIENCE, limits__BODY_S=PATIENCE, connections__LINGER_S=PATIENCE) as (port, _):
        yield port
        # Whatever it went through.
        assert httpx.get(f"http://127.0.0.1:{port}/healthz", timeout=30.0).status_code == 200


def problem(said, status):
    """The document of an answer that must be a problem, with the headers of all answers."""
    assert said is not None
    assert said[0] == status
    assert said[1]["content-type"] == "application/problem+json"
    assert said[1]["x-content-type-options"] == "nosniff"
    document = json.loads(said[2])
    assert document["status"] == status
    return document


def keep_sending(wire, piece, pause_s):
    """Send a piece again and again, for 20 seconds at the most."""
    began = time.monotonic()
    while time.monotonic() - began < 20.0:
        wire.sendall(piece)
        time.sleep(pause_s)


# Size


def test_a_body_may_be_as_large_as_that(port):
    scene = encoded(STILL)
    with connected(port) as wire:
        wire.sendall(asking(scene + b" " * (MOST_BYTES - len(scene)), more="Connection: close\r\n"))
        assert heard(wire)[0] == 200


@pytest.mark.parametrize("size", [MOST_BYTES + 1, 10_000_000])
def test_a_body_that_says_it_is_larger_is_not_read(port, size):
    with connected(port) as wire:
        wire.sendall(HEAD + f"Content-Length: {size}\r\nExpect: 100-continue\r\nConnection: close\r\n\r\n".encode())
        assert "65,536 bytes" in problem(heard(wire), 413)["detail"]


@pytest.mark.parametrize("size", [MOST_BYTES + 1, 1_000_000])
@pytest.mark.parametrize("chunked", [False, True], ids=["with a length", "in chunks"])
def test_who_sends_a_body_that_is_too_large_hears_of_it(port, size, chunked):
    chunks = (b"x" * 8192 for _ in range(size // 8192 + 1))
    said = httpx.post(
        f"http://127.0.0.1:{port}/api/plan",
        content=chunks if chunked else b"x" * size,
        headers={"content-type": "application/json"},
        timeout=30.0,
    )
    assert (said.status_code, said.json()["status"]) == (413, 413)


def test_a_body_without_end_is_cut_off(impatient):
    with connected(impatient) as wire:
        wire.sendall(HEAD + b"Transfer-Encoding: chunked\r\n\r\n")
        with pytest.raises(ConnectionError):
            keep_sending(wire, b"2000\r\n" + b"x" * 8192 + b"\r\n", 0.0)


@pytest.mark.parametrize(
    ("body", "levels"),
    [
        (b"", 0),
        (b"3", 0),
        (b"[]", 1),
        (b'{"a": [1, {"b": 2}], "c": [[]]}', 3),
        (b'"[[[["', 0),
        (rb'["\"[[[["]', 1),
        (rb'["\\", [1]]', 2),
        (b'["[[', 1),
    ],
)
def test_depth_counts_what_is_no_text(body, levels):
    assert depth(body) == levels


def test_nesting_is_allowed_up_to_a_depth(client):
    headers = {"content-type": "application/json"}
    for levels, status in ((MOST_DEPTH, 422), (MOST_DEPTH + 1, 400)):
        said = client.post("/api/plan", content="[" * levels + "]" * levels, headers=headers)
        assert said.status_code == status


def head(size, where):
    """A request whose head has a size, in bytes."""
    around = b"GET /healthz? HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n"
    if where == "the address":
        return around.replace(b"?", b"?" + b"y" * (size - len(around)))
    if where == "a header":
        return around.replace(b"Host", b"X: " + b"y" * (size - len(around) - 5) + b"\r\nHost")
    count, rest = divmod(size - len(around), len(b"X: y\r\n"))
    return around.replace(b"Host", b"X: y\r\n" * count + b"Host").replace(b"?", b"?" + b"y" * rest)


@pytest.mark.parametrize("pieces", [1, 2, 7], ids="{} pieces".format)
@pytest.mark.parametrize("where", ["a header", "many headers", "the address"])
@pytest.mark.parametrize(("size", "status"), [(32_768, 200), (32_769, 431), (40_000, 431), (60_000, 431), (10**6, 431)])
def test_a_head_that_is_too_large_is_refused_however_it_comes(port, size, status, where, pieces):
    sent = head(size, where)
    assert len(sent) == size
    with connected(port) as wire:
        for i in range(pieces):
            wire.sendall(sent[i * size // pieces : (i + 1) * size // pieces])
            time.sleep(0.02)
        said = heard(wire)
    assert said[0] == status
    if status == 431:
        assert "the head of the request is too large: more than 32,768 bytes" in problem(said, 431)["detail"]


def test_a_piece_of_a_body_that_is_too_large_to_be_one_is_no_head(port):
    with connected(port) as wire:
        wire.sendall(HEAD + b"Transfer-Encoding: chunked\r\n\r\n5;" + b"x" * 50_000)
        assert problem(heard(wire), 400)["detail"] == "what came is not a request of HTTP/1.1"


def test_the_second_of_two_heads_may_be_the_one_that_is_too_large(port):
    with connected(port) as wire:
        wire.sendall(b"GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n" + head(200_000, "a header"))
        status, _, rest = heard(wire)
    assert (status, rest.startswith(b'{"status":"ok"')) == (200, True)
    assert b"HTTP/1.1 431 " in rest


@pytest.mark.parametrize("path", ["plan", "fastest", "candidates", "certificate", "export/csv"])
@pytest.mark.parametrize("kind", ["", "Content-Type:\r\n", "Content-Type: text/plain\r\n"])
@pytest.mark.parametrize("body", [encoded(STILL), b"{", b""])
def test_a_body_that_does_not_say_what_it_is_is_refused(port, path, kind, body):
    length = f"Content-Length: {len(body)}\r\nConnection: close\r\n\r\n"
    with connected(port) as wire:
        wire.sendall(f"POST /api/{path} HTTP/1.1\r\nHost: x\r\n{kind}{length}".encode() + body)
        assert problem(heard(wire), 415)["detail"] == "the body must be of the type application/json"


# Slow senders, slow readers


def test_a_head_that_comes_too_slowly_is_told_so(impatient):
    with connected(impatient) as wire:
        began = time.monotonic()
        wire.sendall(b"POST /api/plan HT")
        document = problem(heard(wire), 408)
        assert "the head of the request did not arrive within 1 s" in document["detail"]
        assert time.monotonic() - began >= PATIENCE


def test_a_head_that_drips_is_no_better(impatient):
    # A drop after the end may sweep away what was said.
    with connected(impatient) as wire, pytest.raises(ConnectionError):
        keep_sending(wire, b"X", 0.1)


def test_a_body_that_comes_too_slowly_is_told_so(impatient):
    with connected(impatient) as wire:
        wire.sendall(HEAD + b'Content-Length: 500\r\n\r\n{"pose":')
        assert "the body did not arrive within 1 s" in problem(heard(wire), 408)["detail"]


def test_who_says_nothing_is_parted_from_without_a_word(impatient):
    with connected(impatient) as wire:
        assert heard(wire) is None


def test_who_has_had_an_answer_and_says_no_more_is_parted_from(impatient):
    with connected(impatient) as wire:
        wire.sendall(b"GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n")
        assert heard(wire)[0] == 200


def test_who_leaves_in_the_middle_disturbs_nobody(impatient):
    for part in (b"", b"POST", HEAD, HEAD + b'Content-Length: 500\r\n\r\n{"pose":', asking(encoded(WINDY))):
        with connected(impatient) as wire:
            wire.sendall(part)


def test_who_does_not_read_is_cut_off():
    with serving(connections__WHOLE_S=PATIENCE) as (port, _), connected(port) as wire:
        # More than fits between the two: an answer has some 0.5 MB.
        wire.sendall(b"GET /api/synthesis?cells=400 HTTP/1.1\r\nHost: x\r\n\r\n" * 40)
        # Nothing is read until the server's patience is over; what it had sent by then is all there is.
        time.sleep(4.0 * PATIENCE)
        said = len(answered(wire))
        whole = httpx.get(f"http://127.0.0.1:{port}/api/synthesis?cells=400", timeout=30.0)
        assert 0 < said < 20 * len(whole.content)
        assert httpx.get(f"http://127.0.0.1:{port}/healthz", timeout=30.0).status_code == 200


# No HTTP

GARBAGE = {
    "zeros": b"\x00" * 100 + b"\r\n\r\n",
    "a TLS hello": b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + b"\x5a" * 200 + b"\r\n\r\n",
    "words": b"hello there\r\n\r\n",
    "HTTP/0.9": b"GET /\r\n\r\n",
    "a header without a colon": b"GET / HTTP/1.1\r\nHost\r\n\r\n",
    "no host": b"GET / HTTP/1.1\r\n\r\n",
    "two lengths": b"POST /api/plan HTTP/1.1\r\nHost: x\r\nContent-Length: 3\r\nContent-Length: 4\r\n\r\n{}",
    "a length that is none": b"POST /api/plan HTTP/1.1\r\nHost: x\r\nContent-Length: -3\r\n\r\n{}",
    "a space in a name": b"GET / HTTP/1.1\r\nHost: x\r\nX Y: 1\r\n\r\n",
}


@pytest.mark.parametrize("sent", GARBAGE.values(), ids=GARBAGE)
def test_what_is_no_http_gets_a_problem_document(port, sent):
    with connected(port) as wire:
        wire.sendall(sent)
        assert "HTTP/1.1" in problem(heard(wire), 400)["detail"]
    assert httpx.get(f"http://127.0.0.1:{port}/healthz", timeout=30.0).status_code == 200


def test_a_chunk_that_is_none_ends_the_request(port):
    with connected(port) as wire:
        wire.sendall(HEAD + b"Transfer-Encoding: chunked\r\n\r\nxyz\r\n")
        problem(heard(wire), 400)


def test_garbage_after_a_request_does_not_spoil_its_answer(port):
    with connected(port) as wire:
        wire.sendall(b"GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n\x00\x00 garbage\r\n\r\n")
        status, _, rest = heard(wire)
    assert (status, rest.startswith(b'{"status":"ok"')) == (200, True)
    assert b" 400 " in rest


def test_requests_may_follow_one_another_unasked(port):
    with connected(port) as wire:
        wire.sendall(b"GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n" * 3 + b"GET / HTTP/1.0\r\n\r\n")
        _, _, rest = heard(wire)
    assert rest.count(b'{"status":"ok"') == 3
    assert b"<title>" in rest


# Too many, too long


def test_connections_too_many_are_told_to_come_again():
    with serving(connections__MOST=2) as (port, _):
        with connected(port) as first, connected(port), connected(port) as third:
            request = b"GET /healthz HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n"
            third.sendall(request)
            said = heard(third)
            assert said[1]["retry-after"] == "10"
            assert "2 connections are open already" in problem(said, 503)["detail"]
            first.sendall(request)
            assert heard(first)[0] == 200
        # There is room again.
        assert httpx.get(f"http://127.0.0.1:{port}/healthz", timeout=30.0).status_code == 200


def test_connections_far_too_many_are_cut_off():
    with serving(connections__MOST=2) as (port, _), ExitStack() as stack:
        *_, fifth = (stack.enter_context(connected(port)) for _ in range(5))
        assert heard(fifth) is None


def test_an_answer_that_takes_too_long_is_given_up():
    with serving(limits__ANSWER_S=0.01) as (port, _):
        said = httpx.post(f"http://127.0.0.1:{port}/api/certificate", json=WINDY, timeout=30.0)
        assert (said.status_code, said.headers["retry-after"]) == (503, "10")
        assert "took longer than 0.01 s" in said.json()["detail"]


def test_work_beyond_all_places_is_refused_until_one_is_free():
    async def scenario():
        crew, gate = Workers(threads=1, places=2), threading.Event()
        first, second = (asyncio.ensure_future(crew.run(lambda given: gate.wait(10.0) and given, i)) for i in (1, 2))
        await asyncio.sleep(0)
        with pytest.raises(HTTPException) as refusal:
            await crew.run(str, 3)
        assert (refusal.value.status_code, refusal.value.headers) == (503, {"Retry-After": "1"})
        gate.set()
        assert [await first, await second] == [1, 2]
        return await crew.run(str, 4)

    assert asyncio.run(scenario()) == "4"


def test_work_that_nobody_waits_for_keeps_its_place_until_it_is_done():
    async def scenario():
        crew, gate = Workers(threads=1, places=1), threading.Event()
        with pytest.raises(TimeoutError):
            await asyncio.wait_for(crew.run(lambda _: gate.wait(10.0), 1), 0.05)
        with pytest.raises(HTTPException):
            await crew.run(str, 2)
        gate.set()
        while not crew.places.acquire(blocking=False):
            await asyncio.sleep(0.01)
        crew.places.release()
        return await crew.run(str, 3)

    assert asyncio.run(scenario()) == "3"
