// A hologram in Qt Quick 3D XR: a turning box one metre before the head. Qt asks for the world by XR_FB_passthrough.
//     qml -f hologram.qml        (Qt 6.8 or newer; qml6-module-qtquick3d-xr)
import QtQuick
import QtQuick3D
import QtQuick3D.Xr

XrView {
    referenceSpace: XrView.ReferenceSpaceLocal
    passthroughEnabled: passthroughSupported
    environment: SceneEnvironment {
        backgroundMode: SceneEnvironment.Transparent
        clearColor: "transparent"
    }
    xrOrigin: XrOrigin {}
    DirectionalLight {
        eulerRotation: Qt.vector3d(-40, -30, 0)
        ambientColor: Qt.rgba(0.3, 0.3, 0.3, 1)
    }
    Model {
        // Lengths are centimetres.
        source: "#Cube"
        position: Qt.vector3d(0, 0, -100)
        scale: Qt.vector3d(0.25, 0.25, 0.25)
        materials: PrincipledMaterial { baseColor: "#1f9e89"; roughness: 0.5 }
        NumberAnimation on eulerRotation.y { from: 0; to: 360; duration: 8000; loops: Animation.Infinite }
    }
}
