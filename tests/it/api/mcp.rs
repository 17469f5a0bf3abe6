//! The bridge for language models: a client at its standard input and output, a real console at its socket.

use std::process::{ChildStdin, ChildStdout};

use super::*;

struct Bridge {
    child: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
    sent: u64,
}

impl Bridge {
    fn start(folder: &Path, socket: &Path, options: &[&str]) -> Self {
        let program = program();
        let mut child = Command::new(&program[0])
            .args(&program[1..])
            .args(["mcp", "--api"])
            .arg(socket)
            .args(options)
            .envs(home_variables(folder))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the program runs");
        let input = child.stdin.take();
        let output = BufReader::new(child.stdout.take().expect("it is piped"));
        let mut bridge = Self {
            child,
            input,
            output,
            sent: 0,
        };
        let params = json!({"protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": {"name": "test"}});
        let welcome = bridge.ask("initialize", &params);
        assert_eq!(welcome["result"]["protocolVersion"], "2025-06-18");
        bridge.write(r#"{"jsonrpc": "2.0", "method": "notifications/initialized"}"#);
        bridge
    }

    fn of(served: &Served, options: &[&str]) -> Self {
        Self::start(served.folder.path(), &served.socket(), options)
    }

    fn write(&mut self, line: &str) {
        let input = self.input.as_mut().expect("it is open");
        writeln!(input, "{line}").expect("written");
    }

    fn read(&mut self) -> Value {
        let mut line = String::new();
        self.output.read_line(&mut line).expect("a line");
        serde_json::from_str(&line).expect("a message")
    }

    fn ask(&mut self, method: &str, params: &Value) -> Value {
        self.sent += 1;
        let id = self.sent;
        let request = json!({"jsonrpc": "2.0", "id": id, "method": method, "params": params});
        self.write(&request.to_string());
        let answer = self.read();
        assert_eq!(answer["id"], id, "{answer}");
        answer
    }

    /// Whether a call of a tool failed, and its text.
    fn call(&mut self, name: &str, arguments: &Value) -> (bool, String) {
        let answer = self.ask("tools/call", &json!({"name": name, "arguments": arguments}));
        let result = &answer["result"];
        let text = result["content"][0]["text"].as_str();
        let text = text.unwrap_or_else(|| panic!("{answer}")).to_owned();
        (result["isError"] == true, text)
    }

    /// The state that a tool returns.
    fn state(&mut self, name: &str, arguments: &Value) -> Value {
        let (is_error, text) = self.call(name, arguments);
        assert!(!is_error, "{text}");
        serde_json::from_str(&text).expect("JSON")
    }

    fn tools(&mut self) -> Vec<String> {
        let listed = self.ask("tools/list", &json!({}));
        let tools = listed["result"]["tools"].as_array().expect("tools");
        let names = tools.iter().map(|tool| tool["name"].as_str());
        names.map(|name| name.expect("a name").to_owned()).collect()
    }
}

impl Drop for Bridge {
    fn drop(&mut self) {
        // An error means that it has ended already.
        drop(self.child.kill());
        drop(self.child.wait());
    }
}

#[test]
fn a_model_reads_the_console_and_commands_its_vehicles() {
    let served = Served::start(&["--vehicles", "2", "--speedup", "8"], "--api");
    served.connect().wait_until_ready(2);
    let mut bridge = Bridge::of(&served, &["--allow-commands"]);
    assert!(bridge.tools().contains(&"say".to_owned()));
    for line in ["all mode guided", "all arm", "1 takeoff 10"] {
        let outcome = bridge.state("say", &json!({"line": line}));
        assert_eq!(outcome["done"], true, "{outcome}");
        assert_eq!(outcome["rows"][0]["state"], "done", "{outcome}");
    }
    let vehicles = bridge.state("vehicles", &json!({}));
    assert_eq!(vehicles["list"][0]["in_air"], true, "{vehicles}");
    let ledger = bridge.state("ledger", &json!({}));
    assert_eq!(ledger["list"].as_array().map(Vec::len), Some(3), "{ledger}");
    assert_eq!(bridge.state("plan", &json!({"vehicle": 2}))["vehicle"], 2);
    assert_eq!(
        bridge.state("mission", &json!({})),
        json!({"mission": null})
    );
    let (is_error, text) = bridge.call("say", &json!({"line": "1 takeof 10"}));
    assert!(is_error && text.contains("takeof"), "{text}");
    let (is_error, text) = bridge.call("say", &json!({"line": "1 kill"}));
    assert!(is_error && text.contains("`confirm`"), "{text}");
    // The end of the input ends the bridge, and not the console.
    drop(bridge.input.take());
    assert!(bridge.child.wait().expect("it ends").success());
    served.connect();
}

#[test]
fn a_bridge_gives_commands_only_if_both_sides_allow_it() {
    let commanded = Served::start(&["--vehicles", "1"], "--api");
    let mut reading = Bridge::of(&commanded, &[]);
    assert!(!reading.tools().contains(&"say".to_owned()));
    let call = json!({"name": "say", "arguments": {"line": "1 mode guided"}});
    let refused = reading.ask("tools/call", &call);
    assert_eq!(refused["error"]["code"], -32602, "{refused}");
    assert_eq!(reading.state("ledger", &json!({})), json!({"list": []}));
    let read_only = Served::start(&["--vehicles", "1"], "--api-read-only");
    let mut commanding = Bridge::of(&read_only, &["--allow-commands"]);
    let (is_error, text) = commanding.call("say", &json!({"line": "1 mode guided"}));
    assert!(is_error && text.contains("read-only"), "{text}");
    assert!(commanding.state("links", &json!({}))["list"].is_array());
}

#[test]
fn a_bridge_outlives_its_console_and_hostile_lines() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut early = Bridge::start(folder.path(), &folder.path().join("api"), &[]);
    let (is_error, text) = early.call("vehicles", &json!({}));
    assert!(is_error && text.contains("start a console"), "{text}");
    let served = Served::start(&["--vehicles", "1"], "--api");
    let mut bridge = Bridge::of(&served, &[]);
    for (line, code) in [("{", -32700), ("[]", -32600), ("\u{1b}[2J", -32700)] {
        bridge.write(line);
        assert_eq!(bridge.read()["error"]["code"], code, "{line}");
    }
    bridge.state("vehicles", &json!({}));
    drop(served);
    // The first call may still meet the end of the connection.
    for _ in 0..2 {
        assert!(bridge.call("vehicles", &json!({})).0);
    }
}
