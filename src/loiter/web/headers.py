"""Security headers of every answer: the page runs only its own code, and no other page can embed it in a frame."""

from __future__ import annotations

from starlette.types import ASGIApp, Message, Receive, Scope, Send

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
