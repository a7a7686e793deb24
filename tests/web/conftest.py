"""What the tests of the service share: a real server, and a client of it."""

import httpx
import pytest

from web.serving import serving


@pytest.fixture(scope="session")
def port():
    with serving() as (port, _):
        yield port


@pytest.fixture(scope="session")
def client(port):
    with httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=60.0) as client:
        yield client
