"""Headers: those of every answer let the page run only its own code, in no frame; that of a request names its host."""

from __future__ import annotations

from http import HTTPStatus
from ipaddress import ip_address
from urllib.parse import urlsplit

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from loiter.web.problems import problem

POLICY = "; ".join(
    [
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self'",
        "img-src 'self' data: blob:",
        "connect-src 'self'",
        "frame-src 'self'",
        "font-src 'self'",
        "manifest-src 'self'",
        "base-uri 'none'",
        "form-action 'none'",
        "frame-ancestors 'none'",
    ]
)
HEADERS = {
    "content-security-policy": POLICY,
    "x-content-type-options": "nosniff",
    "x-frame-options": "DENY",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-embedder-policy": "require-corp",
    "cross-origin-resource-policy": "same-origin",
    "permissions-policy": "camera=(), microphone=(), geolocation=(), payment=(), usb=()",
}
SECURITY_HEADERS = [(name.encode(), value.encode()) for name, value in HEADERS.items()]


def map_headers(tile_origin: str) -> dict[str, str]:
    """Headers of the document that draws map tiles: only the page embeds it, and its pictures come from `tile_origin`.

    Tile servers want to know the origin of the page that uses them; they need not send headers that allow the use.
    """
    policy = POLICY.replace("img-src 'self' data: blob:", f"img-src {tile_origin}").replace(
        "frame-ancestors 'none'", "frame-ancestors 'self'"
    )
    return {
        "content-security-policy": policy,
        "x-frame-options": "SAMEORIGIN",
        "referrer-policy": "origin",
        "cross-origin-embedder-policy": "credentialless",
    }


# Answers are never cached. Browsers cache the files of the page, and use their ETag to check for changes.
NO_STORE, NO_CACHE = (b"cache-control", b"no-store"), (b"cache-control", b"no-cache")


class SecurityHeaders:
    """Middleware that adds the security headers and a cache policy to every answer of an app."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve a request."""

        async def with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                given = {name for name, _ in message["headers"]}
                added = [header for header in SECURITY_HEADERS if header[0] not in given]
                message["headers"] = [*message["headers"], *added, NO_CACHE if b"etag" in given else NO_STORE]
            await send(message)

        await self.app(scope, receive, with_headers)


class LoopbackHosts:
    """Middleware of a service on loopback: it refuses requests for another host than this machine, or than `host`.

    A web site could otherwise let its own name point to 127.0.0.1 and read the answers (DNS rebinding).
    """

    def __init__(self, app: ASGIApp, host: str) -> None:
        self.app, self._host = app, host

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve a request, or refuse it with a problem document."""
        asked = next((value.decode("latin-1") for name, value in scope["headers"] if name == b"host"), self._host)
        if is_loopback(host_name(asked)) or host_name(asked) == self._host.lower():
            await self.app(scope, receive, send)
        else:
            detail = f"the request is for the host {asked!r}; this service answers on this machine's own addresses only"
            await problem(HTTPStatus.MISDIRECTED_REQUEST, detail)(scope, receive, send)


def host_name(authority: str) -> str:
    """The host of HOST[:PORT] in small letters, an address without brackets; "" where there is none.

    >>> host_name("LOCALHOST:8300"), host_name("[::1]:8300"), host_name("127.0.0.1")
    ('localhost', '::1', '127.0.0.1')
    """
    try:
        return urlsplit(f"//{authority}").hostname or ""
    except ValueError:
        return ""


def is_loopback(host: str) -> bool:
    """Whether a name or an address is that of this machine on its loopback interface."""
    try:
        return ip_address(host.partition("%")[0]).is_loopback
    except ValueError:
        return host == "localhost" or host.endswith(".localhost")
