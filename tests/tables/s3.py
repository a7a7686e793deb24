"""A store with the protocol of S3 on this machine: objects are in memory, and uploads appear once they are complete."""

import re
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from io import BytesIO
from threading import Thread
from urllib.parse import parse_qs, unquote, urlsplit
from xml.sax.saxutils import escape


class Handler(BaseHTTPRequestHandler):
    """Answers the requests of Arrow's client: objects by their paths, lists of a bucket, uploads in pieces."""

    protocol_version = "HTTP/1.1"
    disable_nagle_algorithm = True

    def log_message(self, *arguments):
        pass

    def _parts(self):
        url = urlsplit(self.path)
        return unquote(url.path).removeprefix("/"), parse_qs(url.query, keep_blank_values=True)

    def _answer(self, status, body=b"", **headers):
        self.send_response(status)
        self.send_header("Content-Length", headers.pop("length", len(body)))
        for name, value in headers.items():
            self.send_header(name.replace("_", "-"), value)
        # In one packet: the client would wait for the second.
        self.wfile.write(b"".join([*self._headers_buffer, b"\r\n", b"" if self.command == "HEAD" else body]))
        self._headers_buffer.clear()

    def _body(self):
        if "chunked" not in self.headers.get("Transfer-Encoding", ""):
            body = self.rfile.read(int(self.headers.get("Content-Length", 0)))
        else:
            body = b"".join(self._chunks(self.rfile))
        return b"".join(self._chunks(BytesIO(body))) if "aws" in self.headers.get("Content-Encoding", "") else body

    @staticmethod
    def _chunks(file):
        """The pieces of a body, each after its size in hexadecimal; further headers may follow the last."""
        while size := int(file.readline().split(b";")[0], 16):
            yield file.read(size)
            file.readline()
        while file.readline().strip():
            pass

    def do_HEAD(self):
        path, _ = self._parts()
        objects = self.server.objects
        if path in objects:
            self._answer(200, length=len(objects[path]), Last_Modified=self._time(path), ETag='"1"')
        else:
            self._answer(200 if "/" not in path.rstrip("/") else 404)

    def _time(self, path):
        minutes, seconds = divmod(self.server.writes.get(path, 0), 60)
        return f"Wed, 21 Oct 2026 07:{minutes:02}:{seconds:02} GMT"

    def do_GET(self):
        path, query = self._parts()
        objects = self.server.objects
        if "list-type" in query:
            self._answer(200, self._listed(path.rstrip("/"), query).encode(), Content_Type="application/xml")
        elif path not in objects:
            self._answer(404, b"<Error><Code>NoSuchKey</Code></Error>")
        else:
            first, last = re.fullmatch(r"bytes=(\d+)-(\d*)", self.headers.get("Range", "bytes=0-")).groups()
            content = objects[path][int(first) : int(last) + 1 if last else None]
            self._answer(206 if "Range" in self.headers else 200, content, Last_Modified=self._time(path), ETag='"1"')

    def _listed(self, bucket, query):
        prefix, delimiter = query.get("prefix", [""])[0], query.get("delimiter", [""])[0]
        keys = sorted(name.removeprefix(f"{bucket}/") for name in self.server.objects if name.startswith(f"{bucket}/"))
        below = [key for key in keys if key.startswith(prefix)]
        folders = {
            prefix + k[len(prefix) :].split("/")[0] + "/" for k in below if delimiter and "/" in k[len(prefix) :]
        }
        files = [k for k in below if not (delimiter and "/" in k[len(prefix) :])]
        shown = "".join(
            f"<Contents><Key>{escape(k)}</Key><Size>{len(self.server.objects[f'{bucket}/{k}'])}</Size>"
            "<LastModified>2026-10-21T07:28:00.000Z</LastModified></Contents>"
            for k in files
        ) + "".join(f"<CommonPrefixes><Prefix>{escape(f)}</Prefix></CommonPrefixes>" for f in sorted(folders))
        return f"<ListBucketResult><IsTruncated>false</IsTruncated>{shown}</ListBucketResult>"

    def do_PUT(self):
        path, query = self._parts()
        body = self._body()
        if "partNumber" in query:
            self.server.pieces.setdefault(path, {})[int(query["partNumber"][0])] = body
        else:
            self._store(path, body)
        self._answer(200, ETag='"1"')

    def _store(self, path, body):
        self.server.objects[path] = body
        self.server.writes[path] = len(self.server.writes)

    def do_POST(self):
        path, query = self._parts()
        body = self._body()
        if "uploads" in query:
            self.server.pieces[path] = {}
            answer = "<InitiateMultipartUploadResult><UploadId>1</UploadId></InitiateMultipartUploadResult>"
        elif "delete" in query:
            for key in re.findall(r"<Key>(.*?)</Key>", body.decode()):
                self.server.objects.pop(f"{path.rstrip('/')}/{key}", None)
            answer = "<DeleteResult></DeleteResult>"
        else:
            self._store(path, b"".join(piece for _, piece in sorted(self.server.pieces[path].items())))
            answer = "<CompleteMultipartUploadResult><ETag>1</ETag></CompleteMultipartUploadResult>"
        self._answer(200, answer.encode(), Content_Type="application/xml")

    def do_DELETE(self):
        self.server.objects.pop(self._parts()[0], None)
        self._answer(204)


def serve():
    """A server that runs until its `shutdown`; its `objects` have their contents by bucket and key."""
    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.objects, server.writes, server.pieces, server.daemon_threads = {}, {}, {}, True
    Thread(target=server.serve_forever, daemon=True).start()
    return server
