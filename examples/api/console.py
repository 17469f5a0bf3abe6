"""A console of sortie that was started with --api SOCKET, for programs in Python 3.9 and later."""

import json
import socket


class Refused(Exception):
    """A line was refused, or not done for every vehicle."""


class Console:
    def __init__(self, path):
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.connect(path)
        self.lines = self.socket.makefile("r", encoding="utf-8")
        self.mission = None
        self.vehicles = {}
        self.sent = 0

    def ask(self, **request):
        """Sends a request, and returns the content of its answer."""
        self.sent += 1
        self.socket.sendall((json.dumps({"id": self.sent, **request}) + "\n").encode())
        while True:
            kind, content = self.next()
            if content.get("id") == self.sent:
                if kind == "fault":
                    raise Refused(content["message"])
                return content

    def next(self):
        """The next message: its kind and its content. Watched states are kept."""
        line = self.lines.readline()
        if not line:
            raise ConnectionError("the console has ended")
        ((kind, content),) = json.loads(line).items()
        if kind == "mission":
            self.mission = content["mission"]
        elif kind == "vehicles":
            self.vehicles.update((one["vehicle"], one) for one in content["list"])
        return kind, content

    def say(self, line, confirm=False):
        """Says a line, and waits until it is done for all its vehicles."""
        entry = self.ask(do="say", line=line, confirm=confirm)["entry"]
        reasons = []
        while entry is not None:
            kind, content = self.next()
            if kind == "row" and content["entry"] == entry and content["remark"]:
                reasons.append(content["remark"])
            if kind == "ended" and content["entry"] == entry:
                if not content["done"]:
                    raise Refused(f"{line}: {'; '.join(reasons)}")
                return

    def watch(self, *topics, every_s=0.2):
        self.ask(do="watch", what=topics, every_s=every_s)

    def wait(self, condition):
        """Reads watched states until the condition holds."""
        while not condition(self):
            self.next()
