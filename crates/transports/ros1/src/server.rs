//! A port of a node: XML-RPC and TCPROS on the same one, distinguished by their first bytes.
//!
//! Requests of HTTP begin with `POST`; as the length of a TCPROS header these four bytes would be 1.4 GB, which is
//! never valid.

use std::collections::BTreeMap;
use std::io::{self, BufReader, Cursor, Read, Write as _};
use std::net::{IpAddr, Shutdown, SocketAddr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::Duration;

use periplus_transport::lock;

use crate::xmlrpc::{self, RpcCall, RpcFault, XmlRpcValue};

/// Maximum number of connections to one port.
const MAX_CONNECTIONS: usize = 512;

/// Timeout of a connection that sends nothing, until its kind is known, and between two requests.
const IDLE: Duration = Duration::from_secs(60);

/// Serves the connections of a port.
pub(crate) trait Handler: Send + Sync + 'static {
    /// Answers a request.
    fn call(&self, call: RpcCall) -> Result<XmlRpcValue, RpcFault>;

    /// Serves a TCPROS connection until it ends. `front` has its first four bytes.
    fn connect(&self, front: [u8; 4], stream: TcpStream);
}

/// A listening port, until this is dropped: its connections end with it.
pub(crate) struct Server {
    address: SocketAddr,
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Default)]
struct Shared {
    is_closing: AtomicBool,
    next_id: AtomicU64,
    open: Mutex<BTreeMap<u64, TcpStream>>,
}

impl Server {
    /// Listens at a port, 0 for a free one.
    pub(crate) fn open(address: IpAddr, port: u16, handler: Arc<dyn Handler>) -> io::Result<Self> {
        let listener = TcpListener::bind((address, port))?;
        let address = listener.local_addr()?;
        let shared = Arc::new(Shared::default());
        let accepting = shared.clone();
        let thread = std::thread::Builder::new().name("ros1-accept".to_owned());
        let thread = thread.spawn(move || accept(&listener, &accepting, &handler))?;
        Ok(Self { address, shared, thread: Some(thread) })
    }

    pub(crate) fn port(&self) -> u16 {
        self.address.port()
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.shared.is_closing.store(true, Ordering::Release);
        // Wakes the thread that waits for connections.
        let mut address = self.address;
        if address.ip().is_unspecified() {
            address.set_ip(IpAddr::from([127, 0, 0, 1]));
        }
        let woken = TcpStream::connect_timeout(&address, Duration::from_secs(1));
        for stream in lock(&self.shared.open).values() {
            let _ = stream.shutdown(Shutdown::Both);
        }
        if let (Some(thread), Ok(_)) = (self.thread.take(), woken) {
            let _ = thread.join();
        }
    }
}

fn accept(listener: &TcpListener, shared: &Arc<Shared>, handler: &Arc<dyn Handler>) {
    loop {
        let accepted = listener.accept();
        if shared.is_closing.load(Ordering::Acquire) {
            return;
        }
        let Ok((stream, _)) = accepted else {
            // Too many open files: wait until some are closed.
            std::thread::sleep(Duration::from_millis(50));
            continue;
        };
        let Ok(copy) = stream.try_clone() else { continue };
        let id = shared.next_id.fetch_add(1, Ordering::Relaxed);
        {
            let mut open = lock(&shared.open);
            if open.len() >= MAX_CONNECTIONS {
                continue;
            }
            open.insert(id, copy);
        }
        let (closing, handler) = (shared.clone(), handler.clone());
        let thread = std::thread::Builder::new().name("ros1-serve".to_owned());
        let spawned = thread.spawn(move || {
            // A connection that fails concerns its peer alone.
            let _ = serve(stream, handler.as_ref());
            lock(&closing.open).remove(&id);
        });
        if spawned.is_err() {
            lock(&shared.open).remove(&id);
        }
    }
}

fn serve(stream: TcpStream, handler: &dyn Handler) -> io::Result<()> {
    stream.set_nodelay(true)?;
    stream.set_read_timeout(Some(IDLE))?;
    stream.set_write_timeout(Some(IDLE))?;
    let mut front = [0; 4];
    (&stream).read_exact(&mut front)?;
    if front.iter().all(|byte| byte.is_ascii_uppercase() || *byte == b' ') {
        return serve_calls(front, &stream, handler);
    }
    handler.connect(front, stream);
    Ok(())
}

fn serve_calls(front: [u8; 4], stream: &TcpStream, handler: &dyn Handler) -> io::Result<()> {
    let mut reader = BufReader::new(Cursor::new(front).chain(stream));
    loop {
        let head = match xmlrpc::read_head(&mut reader, true) {
            Ok(Some(head)) => head,
            Ok(None) | Err(xmlrpc::HttpError::Io(_)) => return Ok(()),
            Err(error) => return refuse(stream, "400 Bad Request", &error.to_string()),
        };
        if head.method != "POST" {
            return refuse(stream, "405 Method Not Allowed", "XML-RPC of ROS 1 takes POST");
        }
        if head.body_bytes.is_none() {
            return refuse(stream, "411 Length Required", "the request has no Content-Length");
        }
        if head.expects_continue {
            (&mut &*stream).write_all(b"HTTP/1.1 100 Continue\r\n\r\n")?;
        }
        let body = match xmlrpc::read_body(&mut reader, &head) {
            Ok(body) => body,
            Err(xmlrpc::HttpError::Io(error)) => return Err(error),
            Err(error) => return refuse(stream, "400 Bad Request", &error.to_string()),
        };
        let answer = match xmlrpc::read_call(&body) {
            Ok(call) => match answer(call, handler) {
                Ok(value) => xmlrpc::write_response(&value),
                Err(fault) => xmlrpc::write_fault(&fault),
            },
            Err(error) => xmlrpc::write_fault(&RpcFault { code: -1, text: error.to_string() }),
        };
        let connection = if head.keeps_open { "keep-alive" } else { "close" };
        let mut bytes = format!(
            "HTTP/1.1 200 OK\r\nServer: periplus\r\nContent-Type: text/xml\r\nConnection: {connection}\r\n\
             Content-Length: {}\r\n\r\n",
            answer.len()
        );
        bytes.push_str(&answer);
        (&mut &*stream).write_all(bytes.as_bytes())?;
        if !head.keeps_open {
            return Ok(());
        }
    }
}

/// Answers a request; `system.multicall` has several in one, as `roslaunch` sends them.
fn answer(call: RpcCall, handler: &dyn Handler) -> Result<XmlRpcValue, RpcFault> {
    if call.method != "system.multicall" {
        return handler.call(call);
    }
    let Some(XmlRpcValue::List(calls)) = call.params.into_iter().next() else {
        return Err(RpcFault { code: -1, text: "system.multicall takes a list of calls".into() });
    };
    let results = calls.into_iter().map(|one| {
        let result = match single(one) {
            Some(call) if call.method != "system.multicall" => handler.call(call),
            _ => Err(RpcFault { code: -1, text: "a call has a methodName and params".into() }),
        };
        match result {
            Ok(value) => XmlRpcValue::List(vec![value]),
            Err(fault) => XmlRpcValue::Struct(
                [
                    ("faultCode".to_owned(), XmlRpcValue::Int(fault.code)),
                    ("faultString".to_owned(), XmlRpcValue::Text(fault.text)),
                ]
                .into(),
            ),
        }
    });
    Ok(XmlRpcValue::List(results.collect()))
}

fn single(value: XmlRpcValue) -> Option<RpcCall> {
    let XmlRpcValue::Struct(mut members) = value else { return None };
    let Some(XmlRpcValue::Text(method)) = members.remove("methodName") else { return None };
    let Some(XmlRpcValue::List(params)) = members.remove("params") else { return None };
    Some(RpcCall { method, params })
}

fn refuse(stream: &TcpStream, status: &str, why: &str) -> io::Result<()> {
    let text = format!(
        "HTTP/1.1 {status}\r\nContent-Type: text/plain\r\nConnection: close\r\nContent-Length: {}\r\n\r\n{why}\n",
        why.len() + 1
    );
    (&mut &*stream).write_all(text.as_bytes())
}
