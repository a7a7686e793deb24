"""Requests that are too large, too slow or not HTTP are refused cleanly over real sockets, and the server goes on."""

import asyncio
import json
import threading
import time
from contextlib import suppress

import httpx
import pytest
from starlette.exceptions import HTTPException

from loiter.web.limits import MAX_BODY_BYTES, MAX_DEPTH, depth
from loiter.web.pool import BoundedPool
from web.serving import connected, encode_request, encode_scene, read_response, run_async, serving
from web.test_api import STILL, WINDY

# Short time-outs for tests, seconds; a request on a busy machine takes less.
TIMEOUT_S = 1.0
HEAD = b"POST /api/plan HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"


@pytest.fixture(scope="module")
def short_timeout_port():
    """The port of a server with short time-outs."""
    with serving(server__KEEP_ALIVE_S=TIMEOUT_S, limits__BODY_TIMEOUT_S=TIMEOUT_S) as (port, _):
        yield port
        # The server still answers after all these tests.
        assert httpx.get(f"http://127.0.0.1:{port}/healthz", timeout=30.0).status_code == 200


def problem(response, status):
    """The problem document of a response; checks its status and headers."""
    assert response is not None
    assert response[0] == status
    assert response[1]["content-type"] == "application/problem+json"
    assert response[1]["x-content-type-options"] == "nosniff"
    document = json.loads(response[2])
    assert document["status"] == status
    return document


# Size


def test_a_body_may_be_as_large_as_the_limit(port):
    scene = encode_scene(STILL)
    with connected(port) as connection:
        connection.sendall(
            encode_request(scene + b" " * (MAX_BODY_BYTES - len(scene)), headers="Connection: close\r\n")
        )
        assert read_response(connection)[0] == 200


@pytest.mark.parametrize("size", [MAX_BODY_BYTES + 1, 10_000_000])
def test_a_body_that_says_it_is_larger_is_not_read(port, size):
    with connected(port) as connection:
        connection.sendall(
            HEAD + f"Content-Length: {size}\r\nExpect: 100-continue\r\nConnection: close\r\n\r\n".encode()
        )
        assert "65,536 bytes" in problem(read_response(connection), 413)["detail"]


@pytest.mark.parametrize("size", [MAX_BODY_BYTES + 1, 1_000_000])
@pytest.mark.parametrize("chunked", [False, True], ids=["with a length", "in chunks"])
def test_a_body_that_is_too_large_is_answered_with_413(port, size, chunked):
    chunks = (b"x" * 8192 for _ in range(size // 8192 + 1))
    response = httpx.post(
        f"http://127.0.0.1:{port}/api/plan",
        content=chunks if chunked else b"x" * size,
        headers={"content-type": "application/json"},
        timeout=30.0,
    )
    assert (response.status_code, response.json()["status"]) == (413, 413)


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
def test_depth_ignores_strings(body, levels):
    assert depth(body) == levels


def test_nesting_is_allowed_up_to_a_depth(client):
    headers = {"content-type": "application/json"}
    for levels, status in ((MAX_DEPTH, 422), (MAX_DEPTH + 1, 400)):
        response = client.post("/api/plan", content="[" * levels + "]" * levels, headers=headers)
        assert response.status_code == status


def head(size, where):
    """A request whose head has a size, in bytes."""
    around = b"GET /healthz? HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"
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
    with connected(port) as connection:
        # uvicorn itself refuses those that arrive in pieces, and resets a connection that goes on sending.
        with suppress(ConnectionError):
            for i in range(pieces):
                connection.sendall(sent[i * size // pieces : (i + 1) * size // pieces])
                time.sleep(0.02)
        response = read_response(connection)
    if status == 200:
        assert response[0] == 200
    elif response is not None and response[0] == 431:
        assert "the head of the request is too large: more than 32,768 bytes" in problem(response, 431)["detail"]
    else:
        assert pieces > 1 or size > 65_536
        assert response is None or response[0] == 400


@pytest.mark.parametrize("path", ["plan", "candidates", "certificate", "export/csv"])
@pytest.mark.parametrize("kind", ["", "Content-Type:\r\n", "Content-Type: text/plain\r\n"])
@pytest.mark.parametrize("body", [encode_scene(STILL), b"{", b""])
def test_a_body_without_the_type_json_is_refused(port, path, kind, body):
    length = f"Content-Length: {len(body)}\r\nConnection: close\r\n\r\n"
    with connected(port) as connection:
        connection.sendall(f"POST /api/{path} HTTP/1.1\r\nHost: localhost\r\n{kind}{length}".encode() + body)
        assert problem(read_response(connection), 415)["detail"] == "the body must be of the type application/json"


# Slow senders, slow readers


def test_a_body_that_arrives_too_slowly_is_answered_with_408(short_timeout_port):
    with connected(short_timeout_port) as connection:
        connection.sendall(HEAD + b'Content-Length: 500\r\n\r\n{"pose":')
        assert "the body did not arrive within 1 s" in problem(read_response(connection), 408)["detail"]


def test_an_idle_connection_is_closed_after_an_answer(short_timeout_port):
    with connected(short_timeout_port) as connection:
        connection.sendall(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n")
        assert read_response(connection)[0] == 200


def test_a_client_that_disconnects_midway_does_not_disturb_the_server(short_timeout_port):
    for part in (
        b"",
        b"POST",
        HEAD,
        HEAD + b'Content-Length: 500\r\n\r\n{"pose":',
        encode_request(encode_scene(WINDY)),
    ):
        with connected(short_timeout_port) as connection:
            connection.sendall(part)


# Invalid HTTP

GARBAGE = {
    "zeros": b"\x00" * 100 + b"\r\n\r\n",
    "a TLS hello": b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + b"\x5a" * 200 + b"\r\n\r\n",
    "words": b"hello there\r\n\r\n",
    "HTTP/0.9": b"GET /\r\n\r\n",
    "a header without a colon": b"GET / HTTP/1.1\r\nHost\r\n\r\n",
    "no host": b"GET / HTTP/1.1\r\n\r\n",
    "two lengths": b"POST /api/plan HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3\r\nContent-Length: 4\r\n\r\n{}",
    "a negative length": b"POST /api/plan HTTP/1.1\r\nHost: localhost\r\nContent-Length: -3\r\n\r\n{}",
    "a space in a name": b"GET / HTTP/1.1\r\nHost: localhost\r\nX Y: 1\r\n\r\n",
}


@pytest.mark.parametrize("sent", GARBAGE.values(), ids=GARBAGE)
def test_invalid_http_is_refused(port, sent):
    with connected(port) as connection:
        connection.sendall(sent)
        assert read_response(connection)[0] == 400
    assert httpx.get(f"http://127.0.0.1:{port}/healthz", timeout=30.0).status_code == 200


def test_an_invalid_chunk_ends_the_request(port):
    with connected(port) as connection:
        connection.sendall(HEAD + b"Transfer-Encoding: chunked\r\n\r\nxyz\r\n")
        assert read_response(connection)[0] == 400


def test_garbage_after_a_request_does_not_spoil_its_answer(port):
    with connected(port) as connection:
        connection.sendall(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n\x00\x00 garbage\r\n\r\n")
        status, _, rest = read_response(connection)
    assert (status, rest.startswith(b'{"status":"ok"')) == (200, True)
    assert b" 400 " in rest


def test_requests_may_be_pipelined(port):
    with connected(port) as connection:
        connection.sendall(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n" * 3 + b"GET / HTTP/1.0\r\n\r\n")
        _, _, rest = read_response(connection)
    assert rest.count(b'{"status":"ok"') == 3
    assert b"<title>" in rest


# Too many, too long


def test_requests_are_refused_while_too_many_connections_are_open():
    with serving(server__MAX_CONNECTIONS=3) as (port, _):
        request = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"
        with connected(port), connected(port), connected(port) as third:
            third.sendall(request)
            assert read_response(third)[0] == 503
        # The connections are closed: new ones are served.
        assert httpx.get(f"http://127.0.0.1:{port}/healthz", timeout=30.0).status_code == 200


def test_an_answer_that_takes_too_long_is_abandoned():
    with serving(limits__ANSWER_TIMEOUT_S=0.0001) as (port, _):
        response = httpx.post(f"http://127.0.0.1:{port}/api/certificate", json=WINDY, timeout=30.0)
        assert (response.status_code, response.headers["retry-after"]) == (503, "10")
        assert "took longer than 0.0001 s" in response.json()["detail"]


def test_work_is_refused_while_the_pool_is_full():
    async def scenario():
        pool, gate = BoundedPool(threads=1, capacity=2), threading.Event()
        first, second = (asyncio.ensure_future(pool.run(lambda given: gate.wait(10.0) and given, i)) for i in (1, 2))
        await asyncio.sleep(0)
        with pytest.raises(HTTPException) as refusal:
            await pool.run(str, 3)
        assert (refusal.value.status_code, refusal.value.headers) == (503, {"Retry-After": "1"})
        gate.set()
        assert [await first, await second] == [1, 2]
        return await pool.run(str, 4)

    assert run_async(scenario()) == "4"


def test_abandoned_work_keeps_its_slot_until_it_is_done():
    async def scenario():
        pool, gate = BoundedPool(threads=1, capacity=1), threading.Event()
        with pytest.raises(TimeoutError):
            await asyncio.wait_for(pool.run(lambda _: gate.wait(10.0), 1), 0.05)
        with pytest.raises(HTTPException):
            await pool.run(str, 2)
        gate.set()
        while not pool.free_slots.acquire(blocking=False):
            await asyncio.sleep(0.01)
        pool.free_slots.release()
        return await pool.run(str, 3)

    assert run_async(scenario()) == "3"
